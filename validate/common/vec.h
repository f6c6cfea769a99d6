#pragma once

#include <glm/glm.hpp>

namespace gnomon {

/// Vectors of the measurement, in double precision. GPU buffers hold floats, made at the boundary.
using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;

constexpr double pi = 3.14159265358979323846;

/// Degrees to radians. Study files speak in degrees, the code in radians.
constexpr double radians(double degrees) {
  return degrees * pi / 180.0;
}

/// The number of degrees, with as few digits as it takes, whose `radians` are this number to the
/// bit; the nearest where there is none (there always is for an angle that was read in degrees).
double degreesOf(double angle);

}  // namespace gnomon
