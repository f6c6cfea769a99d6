#pragma once

#include <string>
#include <vector>

#include "common/vec.h"
#include "study/spec/sections/study_key.h"

namespace gnomon::study {

/// A directional light. Azimuth counter-clockwise from +x about +z, elevation over the xy plane.
struct LightSpec {
  std::string name;
  double azimuth;    ///< radians
  double elevation;  ///< radians
  /// The unit vector toward the light.
  [[nodiscard]] Vec3 direction() const;
};

/// `[[light]]` as the file has it: one light, or every elevation with every azimuth.
struct LightSection {
  std::vector<double> elevations;      ///< degrees
  std::vector<double> azimuths = {0};  ///< degrees
  std::string name;
};

inline StudyKeys keysOf(LightSection& light) {
  return {
      studyKey("elevation", NumberOrList{&light.elevations}, "degrees over the xy plane", {-90, 90},
               required),
      studyKey("azimuth", NumberOrList{&light.azimuths}, "degrees from +x about +z", {-360, 360}),
      studyKey("name", &light.name, "of a light that stands alone", {},
               "`\"elevation 24° azimuth 165°\"`", Enters::nothing)};
}

/// The lights of a section, in the order of azimuths, and of elevations under each.
/// @throws InputError as TomlReader, for a name of several lights too
std::vector<LightSpec> readLights(const TomlReader& section);

/// One light as a section of its own.
LightSection sectionOf(const LightSpec& light);

}  // namespace gnomon::study
