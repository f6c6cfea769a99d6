#include "model/light_angles.h"

#include <algorithm>
#include <cmath>

#include "study/light_name.h"

namespace gnomon {
namespace {

/// To a thousandth of a degree.
double rounded(double degrees) {
  return std::round(1000 * degrees) / 1000;
}

}  // namespace

double degreesOf(double angle) {
  const double near = angle * 180 / pi;
  double scale = 1;
  for (int digits = 0; digits <= 12; ++digits, scale *= 10) {
    const double shorter = std::round(near * scale) / scale;
    if (radians(shorter) == angle) return shorter;
  }
  for (const double far : {near - 1, near + 1}) {
    double next = near;
    for (int step = 0; step < 4; ++step, next = std::nextafter(next, far)) {
      if (radians(next) == angle) return next;
    }
  }
  return near;
}

LightAngles lightAngles(const LightSpec& light) {
  return {degreesOf(light.azimuth), degreesOf(light.elevation)};
}

LightSpec lightSpec(const LightAngles& angles) {
  return {lightName(angles.azimuth, angles.elevation), radians(angles.azimuth),
          radians(angles.elevation)};
}

LightAngles dragged(const LightAngles& angles, double azimuthChange, double elevationChange) {
  const double azimuth = rounded(angles.azimuth + azimuthChange);
  const double within = rounded(azimuth - 360 * std::floor(azimuth / 360));
  return {within < 360 ? within : 0,
          std::clamp(rounded(angles.elevation + elevationChange), -90.0, 90.0)};
}

}  // namespace gnomon
