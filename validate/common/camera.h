#pragma once

#include <cmath>

#include "common/vec.h"

namespace gnomon {

/// A pinhole camera. The picture's row 0 is its top; pixel centres lie at + 0.5.
struct Camera {
  Vec3 eye{0, 0, 1};
  Vec3 target{0, 0, 0};
  Vec3 up{0, 1, 0};
  double verticalFov = radians(30);  ///< full angle, radians
  int width = 512;                   ///< pixels
  int height = 512;                  ///< pixels
};

/// The camera's axes in the world: right, up and backward (from the target to the eye), unit.
struct CameraAxes {
  Vec3 right, up, back;
};

inline CameraAxes axes(const Camera& camera) {
  const Vec3 back = glm::normalize(camera.eye - camera.target);
  const Vec3 right = glm::normalize(glm::cross(camera.up, back));
  return {right, glm::cross(back, right), back};
}

/// The unit direction of the ray through the centre of a pixel.
inline Vec3 pixelDirection(const Camera& camera, const CameraAxes& axis, int column, int row) {
  const double tangent = std::tan(camera.verticalFov / 2);
  const double aspect = static_cast<double>(camera.width) / camera.height;
  const double x = (2 * (column + 0.5) / camera.width - 1) * tangent * aspect;
  const double y = (1 - 2 * (row + 0.5) / camera.height) * tangent;
  return glm::normalize(x * axis.right + y * axis.up - axis.back);
}

}  // namespace gnomon
