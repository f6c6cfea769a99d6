#pragma once

#include <string>
#include <string_view>

#include "study/record/sweep_record.h"

namespace gnomon::report {

/// The value of "schema". A reader may rely on the keys below as long as it does not change.
constexpr std::string_view sweepSchema = "gnomon-sweep/3";

/// A sweep as JSON: docs/summary.md documents every key.
/// @throws InternalError naming the key for a number that is not finite
std::string sweepJson(const study::SweepRecord& sweep);

}  // namespace gnomon::report
