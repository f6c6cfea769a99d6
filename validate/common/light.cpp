#include "common/light.h"

#include <fmt/core.h>

#include <cmath>

namespace gnomon {

Light makeLight(const LightAngles& angles, const std::string& name) {
  const double azimuth = radians(angles.azimuth);
  const double elevation = radians(angles.elevation);
  Light light{{std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
               std::sin(elevation)},
              radians(angles.radius),
              name,
              angles};
  if (name.empty()) {
    light.name = fmt::format("elevation {}° azimuth {}°", angles.elevation, angles.azimuth);
    if (light.isSoft()) light.name += fmt::format(" radius {}°", angles.radius);
  }
  return light;
}

}  // namespace gnomon
