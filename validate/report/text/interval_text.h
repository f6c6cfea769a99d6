#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "compare/confidence_interval.h"

namespace gnomon::report {

/// Both ends as percent with two decimals: "−1.20 to 50.00"; "–" where there is no interval.
std::string intervalText(const std::optional<compare::Interval>& interval);

/// One end likewise: "−1.20"; "–" for none.
std::string intervalEndText(std::optional<double> end);

/// What an interval means, in one sentence: the same in every kind of report.
constexpr std::string_view intervalMeaning =
    "In 95 of 100 cases a 95 % interval contains the mean over all random draws of the bumps, on "
    "the same surface, in the same view, under the same lights.";

/// An end, or nothing.
std::optional<double> lowOf(const std::optional<compare::Interval>& interval);
std::optional<double> highOf(const std::optional<compare::Interval>& interval);

}  // namespace gnomon::report
