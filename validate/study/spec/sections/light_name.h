#pragma once

#include <fmt/core.h>

#include <string>

namespace gnomon::study {

/// The name of a light that its study gives none, from its angles in degrees:
/// "elevation 24° azimuth 165°".
inline std::string lightName(double azimuth, double elevation) {
  return fmt::format("elevation {}° azimuth {}°", elevation, azimuth);
}

}  // namespace gnomon::study
