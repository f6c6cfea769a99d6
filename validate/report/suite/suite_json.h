#pragma once

#include <span>
#include <string>
#include <string_view>

#include "study/judge/suite/suite_statistics.h"

namespace gnomon::report {

/// The value of "schema". A reader may rely on the keys below as long as it does not change.
constexpr std::string_view suiteSchema = "gnomon-suite/1";

/// The statistics over the scenes of a suite as JSON: docs/summary.md documents every key.
/// @throws InternalError naming the key for a number that is not finite
std::string suiteJson(const study::SuiteStatistics& statistics, std::string_view command);

}  // namespace gnomon::report
