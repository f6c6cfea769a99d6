#include "study/spec/sections/light_section.h"

#include <cmath>

#include "common/degrees.h"
#include "study/spec/sections/light_name.h"

namespace gnomon::study {

Vec3 LightSpec::direction() const {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

std::vector<LightSpec> readLights(const TomlReader& section) {
  LightSection light;
  section.allow(namesOf(keysOf(light)));
  readKeys(section, keysOf(light));
  const bool isSingle = light.elevations.size() * light.azimuths.size() == 1;
  if (section.has("name") && !isSingle) {
    section.fail("name", "a name found for several lights, which are named by their angles");
  }
  std::vector<LightSpec> lights;
  for (const double azimuth : light.azimuths) {
    for (const double elevation : light.elevations) {
      lights.push_back({light.name.empty() ? lightName(azimuth, elevation) : light.name,
                        radians(azimuth), radians(elevation)});
    }
  }
  return lights;
}

LightSection sectionOf(const LightSpec& light) {
  return {{degreesOf(light.elevation)}, {degreesOf(light.azimuth)}, light.name};
}

}  // namespace gnomon::study
