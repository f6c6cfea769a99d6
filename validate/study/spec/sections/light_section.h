#pragma once

#include <string>
#include <vector>

#include "common/light.h"
#include "study/spec/sections/study_key.h"

namespace gnomon::study {

/// The sun's angular radius as seen from the Earth, degrees: mean over the year.
constexpr double sunRadius = 0.266;
/// The largest angular radius of a light, degrees.
constexpr double largestLightRadius = 10;

/// `[[light]]` as the file has it: one light, or every elevation with every azimuth.
struct LightSection {
  std::vector<double> elevations;      ///< degrees
  std::vector<double> azimuths = {0};  ///< degrees
  std::string name;
  double radius = 0;  ///< degrees
  bool sun = false;
};

inline StudyKeys keysOf(LightSection& light) {
  return {
      studyKey("elevation", NumberOrList{&light.elevations}, "degrees over the xy plane", {-90, 90},
               required),
      studyKey("azimuth", NumberOrList{&light.azimuths}, "degrees from +x about +z", {-360, 360}),
      studyKey("name", &light.name, "of a light that stands alone", {},
               "`\"elevation 24° azimuth 165°\"`", Enters::nothing),
      studyKey("radius", Unusual{&light.radius},
               "degrees: angular radius of the light's disc, for soft shadows; 0 is a point",
               {0, largestLightRadius}),
      studyKey("sun", Unusual{&light.sun}, "in place of `radius`: that of the sun, 0.266°")};
}

/// The lights of a section, in the order of azimuths, and of elevations under each.
/// @throws InputError as TomlReader, for a name of several lights and for two radii too
std::vector<Light> readLights(const TomlReader& section);

/// One light as a section of its own.
LightSection sectionOf(const Light& light);

}  // namespace gnomon::study
