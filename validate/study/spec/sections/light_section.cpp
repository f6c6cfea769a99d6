#include "study/spec/sections/light_section.h"

namespace gnomon::study {

std::vector<Light> readLights(const TomlReader& section) {
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
  std::vector<Light> lights;
  for (const double azimuth : light.azimuths) {
    for (const double elevation : light.elevations) {
      lights.push_back(makeLight({azimuth, elevation, radius}, light.name));
    }
  }
  return lights;
}

LightSection sectionOf(const Light& light) {
  return {{light.angles.elevation}, {light.angles.azimuth}, light.name, light.angles.radius};
}

}  // namespace gnomon::study
