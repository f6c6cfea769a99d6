#include "study/spec/sections/light_section.h"

#include <cmath>

#include "common/degrees.h"
#include "study/spec/sections/light_name.h"
#include "truth/disc_directions.h"

namespace gnomon::study {

Vec3 LightSpec::direction() const {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

Vec3 LightSpec::lowestDirection() const {
  return truth::lowestOfDisc(direction(), radius);
}

std::vector<LightSpec> readLights(const TomlReader& section) {
  LightSection light;
  section.allow(namesOf(keysOf(light)));
  readKeys(section, keysOf(light));
  const bool isSingle = light.elevations.size() * light.azimuths.size() == 1;
  if (section.has("name") && !isSingle) {
    section.fail("name", "a name found for several lights, which are named by their angles");
  }
  if (section.has("sun") && section.has("radius")) {
    section.fail("sun", "`radius` found beside it, one of the two expected");
  }
  const double radius = light.sun ? sunRadius : light.radius;
  std::vector<LightSpec> lights;
  for (const double azimuth : light.azimuths) {
    for (const double elevation : light.elevations) {
      lights.push_back({light.name.empty() ? lightName(azimuth, elevation, radius) : light.name,
                        radians(azimuth), radians(elevation), radians(radius)});
    }
  }
  return lights;
}

LightSection sectionOf(const LightSpec& light) {
  return {{degreesOf(light.elevation)},
          {degreesOf(light.azimuth)},
          light.name,
          degreesOf(light.radius)};
}

}  // namespace gnomon::study
