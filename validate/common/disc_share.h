#pragma once

#include <algorithm>
#include <cmath>

#include "common/vec.h"

namespace gnomon {

/// V of a light's disc whose centre stands x of its radii over a straight horizon:
/// 1 - (acos x - x √(1 - x²)) / π for -1 < x < 1, else 0 or 1. A flat disc's, the limit of small
/// radii: of a radius of 5° it is within 0.002 of a cap's solid angle.
inline double discShare(double x) {
  const double within = std::clamp(x, -1.0, 1.0);
  return 1 - (std::acos(within) - within * std::sqrt(1 - within * within)) / pi;
}

}  // namespace gnomon
