#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace gnomon {

/// The value below which a share of the values lies, linear between the two nearest of them: the
/// smallest for 0, the median for 0.5, the largest for 1; exact where these two are equal.
/// @param sorted  ascending, one value or more
/// @param share   0 to 1
inline double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

/// The same of values in any order, which it changes.
inline double takeQuantile(std::vector<double>& values, double share) {
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = values.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(values.begin(), below, values.end());
  const auto above = std::min_element(below + 1, values.end());
  const double next = above == values.end() ? *below : *above;
  return *below + (place - std::floor(place)) * (next - *below);
}

}  // namespace gnomon
