#include "study/spec/suite/exact_degrees.h"

#include <cmath>

namespace gnomon::study {
namespace {

/// Σ (-1)^k x^(2k + first) / (2k + first)! for |x| ≤ π/4.
double series(double x, int first) {
  double term = first == 0 ? 1 : x;
  double sum = 0;
  for (int n = first; n < 24; n += 2) {
    sum += term;
    term *= -x * x / ((n + 1.0) * (n + 2.0));
  }
  return sum;
}

}  // namespace

SineCosine sineCosine(double degrees) {
  const double quarters = std::floor(degrees / 90 + 0.5);
  const double x = (degrees - 90 * quarters) * (pi / 180);
  const double sine = series(x, 1);
  const double cosine = series(x, 0);
  switch (static_cast<int>(quarters - 4 * std::floor(quarters / 4))) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

Vec3 exactDirection(double elevation, double azimuth) {
  const SineCosine up = sineCosine(elevation);
  const SineCosine round = sineCosine(azimuth);
  return {up.cosine * round.cosine, up.cosine * round.sine, up.sine};
}

}  // namespace gnomon::study
