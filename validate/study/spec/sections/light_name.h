#pragma once

#include <fmt/core.h>

#include <string>

namespace gnomon::study {

/// The name of a light that its study gives none, from its angles in degrees:
/// "elevation 24° azimuth 165°"; of a disc its radius too, "elevation 24° azimuth 165° radius
/// 0.266°".
inline std::string lightName(double azimuth, double elevation, double radius = 0) {
  const std::string angles = fmt::format("elevation {}° azimuth {}°", elevation, azimuth);
  return radius > 0 ? fmt::format("{} radius {}°", angles, radius) : angles;
}

}  // namespace gnomon::study
