#pragma once

#include <algorithm>
#include <cmath>

#include "common/vec.h"

namespace gnomon::test {

/// The share of a flat disc above a straight horizon: its centre at elevation θ, the horizon at β,
/// the disc's radius ρ, in one unit.
inline double flatShare(double theta, double beta, double rho) {
  const double x = std::clamp((theta - beta) / rho, -1.0, 1.0);
  return 1 - (std::acos(x) - x * std::sqrt(1 - x * x)) / pi;
}

/// The share of a cap's solid angle above a great circle, the cap's centre an angle δ over it: over
/// rings of the cap at the angle a from its centre, of which the part where
/// cos φ > -tan δ / tan a is above.
inline double capShare(double delta, double rho) {
  constexpr int rings = 4000;
  double sum = 0;
  for (int k = 0; k < rings; ++k) {
    const double cosine = 1 - (1 - std::cos(rho)) * (k + 0.5) / rings;
    const double edge = -std::tan(delta) * cosine / std::sqrt(1 - cosine * cosine);
    sum += std::acos(std::clamp(edge, -1.0, 1.0)) / pi;
  }
  return sum / rings;
}

}  // namespace gnomon::test
