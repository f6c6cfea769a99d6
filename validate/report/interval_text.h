#pragma once

#include <optional>
#include <string>

#include "compare/confidence_interval.h"

namespace gnomon {

/// Both ends as percent with two decimals: "−1.20 to 50.00"; "–" where there is no interval.
std::string intervalText(const std::optional<Interval>& interval);

/// An end, or nothing.
std::optional<double> lowOf(const std::optional<Interval>& interval);
std::optional<double> highOf(const std::optional<Interval>& interval);

}  // namespace gnomon
