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

/// What a key is drawn from.
struct SweptDistribution {
  enum class Kind { uniform, logUniform, whole, choice };
  Kind kind = Kind::uniform;
  double low = 0, high = 1;             ///< both included
  std::vector<SweptValue> values = {};  ///< of a choice
};

/// The distribution of a `[[sweep]]` table with `draw`:
///   "uniform:5:85"          low + u·(high - low)
///   "log-uniform:0.01:1"    low·(high/low)^u, both above 0
///   "whole:1:6"             a whole number, each as likely as any other
///   "choice"                of `values`, likewise
/// @throws InputError for anything else
SweptDistribution distributionOf(const TomlReader& section);

/// One draw of a key, rounded to 9 digits: with u = randomUnit(seed, key, index). It depends
/// neither on the other keys nor on the number of draws.
SweptValue drawnValue(const SweptDistribution& distribution, std::uint64_t seed,
                      std::string_view key, std::size_t index);

}  // namespace gnomon::study
