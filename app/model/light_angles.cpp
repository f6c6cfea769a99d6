#include "model/light_angles.h"

#include <algorithm>
#include <cmath>

#include "common/degrees.h"
#include "study/spec/sections/light_name.h"

namespace gnomon::app {
namespace {

/// To a thousandth of a degree.
double rounded(double degrees) {
  return std::round(1000 * degrees) / 1000;
}

}  // namespace

LightAngles lightAngles(const study::LightSpec& light) {
  return {degreesOf(light.azimuth), degreesOf(light.elevation), degreesOf(light.radius)};
}

study::LightSpec lightSpec(const LightAngles& angles) {
  return {study::lightName(angles.azimuth, angles.elevation, angles.radius),
          radians(angles.azimuth), radians(angles.elevation), radians(angles.radius)};
}

LightAngles dragged(const LightAngles& angles, double azimuthChange, double elevationChange) {
  const double azimuth = rounded(angles.azimuth + azimuthChange);
  const double within = rounded(azimuth - 360 * std::floor(azimuth / 360));
  return {within < 360 ? within : 0,
          std::clamp(rounded(angles.elevation + elevationChange), -90.0, 90.0), angles.radius};
}

}  // namespace gnomon::app
