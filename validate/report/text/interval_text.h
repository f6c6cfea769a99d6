#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "compare/confidence_interval.h"

namespace gnomon {

/// Both ends as percent with two decimals: "−1.20 to 50.00"; "–" where there is no interval.
std::string intervalText(const std::optional<Interval>& interval);

/// What an interval speaks of, in one sentence: the same in every kind of report.
constexpr std::string_view intervalMeaning =
    "An interval of 95 % holds, in 95 of 100 cases, the mean over all draws of the bumps, on the "
    "same surface, in the same view, under the same lights.";

/// An end, or nothing.
std::optional<double> lowOf(const std::optional<Interval>& interval);
std::optional<double> highOf(const std::optional<Interval>& interval);

}  // namespace gnomon
