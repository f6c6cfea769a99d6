#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "study/record/swept_value.h"
#include "study/spec/toml/toml_reader.h"

namespace gnomon::study {

/// The most values of a key.
constexpr std::size_t mostSweepValues = 100'000;

/// The values of a `[[sweep]]` table: a list of numbers, of texts, of true and false, or of flat
/// lists; or a text that stands for numbers:
///   "5:85:5"           first, last and step: first + i·step up to the last, which must be one of
///                      them; a last below the first goes with a step below 0
///   "log:0.001:0.1:7"  first, last and count: first·(last/first)^(i/(count - 1)), both above 0
/// Numbers of a range are rounded to 12 digits, those of a geometric one to 6: so that they read
/// well, and are the same on every machine. First and last are as they are written.
/// @throws InputError for anything else, and for over mostSweepValues values
std::vector<SweptValue> sweepValues(const TomlReader& section, std::string_view key);

}  // namespace gnomon::study
