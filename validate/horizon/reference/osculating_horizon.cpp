#include "horizon/reference/osculating_horizon.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/vec.h"

namespace gnomon::horizon {
namespace {

constexpr double nothing = -std::numeric_limits<double>::infinity();

/// Below this angle sine and tangent are the angle itself, to double precision.
constexpr double smallAngle = 1e-8;

/// Of 1 + κh: no bump in a bowl reaches the circle's centre.
constexpr double leastGround = 1e-3;

}  // namespace

double smallAngleHorizon(const HorizonLookups& at) {
  return at.slope * (1 - at.curvature * at.height) - at.curvature * at.arcLength / 2;
}

double unreducedHorizon(const HorizonLookups& at) {
  const double angle = at.curvature * at.arcLength;
  if (std::abs(angle) > pi / 2) return nothing;
  // Above and below divided by R + h = (1 + κh) / κ; 2 sin(γ/2) cos(γ/2) = sin γ.
  const double ground = std::max(1 + at.curvature * at.height, leastGround);
  const double shrink = std::abs(angle) < smallAngle ? 1 : angle / std::tan(angle);
  return at.slope / ground * shrink - std::tan(angle / 2);
}

double osculatingHorizon(const HorizonLookups& at) {
  const double angle = at.curvature * at.arcLength;
  if (std::abs(angle) > pi / 2) return nothing;
  // With cos γ = 1 - 2 sin²(γ/2), to have no difference of two numbers near 1.
  const double peak =
      std::max(1 + at.curvature * (at.height + at.slope * at.arcLength), leastGround);
  const double stretch = std::abs(angle) < smallAngle ? 1 : angle / std::sin(angle);
  return at.slope / peak * stretch - std::tan(angle / 2);
}

double bareHorizon(double curvature, double height) {
  if (!(curvature > 0)) return nothing;
  const double rise = curvature * std::max(height, 0.0);
  return -std::sqrt(rise * (rise + 2));
}

}  // namespace gnomon::horizon
