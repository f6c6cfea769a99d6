#pragma once

#include <algorithm>
#include <cmath>

#include "common/mask.h"
#include "truth/truth_scenes.h"

namespace gnomon::test {

/// V of a disc whose centre stands `over` its straight horizon, both angles in radians:
/// 1 - (acos x - x √(1 - x²)) / π, x = over / radius. A flat disc's, the limit of small radii.
inline double shareOver(double over, double radius) {
  const double x = std::clamp(over / radius, -1.0, 1.0);
  return 1 - (std::acos(x) - x * std::sqrt(1 - x * x)) / pi;
}

/// Mean of |a - b| over the samples of both.
inline double meanDifference(const Visibility& a, const Visibility& b) {
  double sum = 0;
  double all = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isnan(a.shares[i]) || std::isnan(b.shares[i])) continue;
    sum += std::abs(static_cast<double>(a.shares[i]) - static_cast<double>(b.shares[i]));
    all += 1;
  }
  return all == 0 ? 1.0 : sum / all;
}

}  // namespace gnomon::test
