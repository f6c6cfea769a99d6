#include "model/orbit.h"

#include <algorithm>

namespace gnomon::app {

Camera orbited(const Camera& camera, double azimuth, double elevation) {
  const Vec3 offset = camera.eye - camera.target;
  const double distance = glm::length(offset);
  const Vec3 up = glm::normalize(camera.up);
  const Vec3 level = offset - glm::dot(offset, up) * up;
  const double run = glm::length(level);
  // Over a pole there is no azimuth; no view is made of such a camera.
  if (!(run > 1e-12 * distance)) return camera;
  const double before = std::atan2(glm::dot(offset, up), run);
  const double highest = std::max(radians(89), std::abs(before));
  const double after = std::clamp(before + elevation, -highest, highest);
  const Vec3 forward = level / run;
  const Vec3 turned = std::cos(azimuth) * forward + std::sin(azimuth) * glm::cross(up, forward);
  Camera moved = camera;
  moved.eye = camera.target + distance * (std::cos(after) * turned + std::sin(after) * up);
  return moved;
}

Camera zoomed(const Camera& camera, double factor, const ZoomRange& range) {
  const Vec3 offset = camera.eye - camera.target;
  const double distance = glm::length(offset);
  if (!(distance > 0)) return camera;
  const double wanted = std::clamp(factor * distance, range.nearest, range.farthest);
  Camera moved = camera;
  moved.eye = camera.target + wanted / distance * offset;
  return moved;
}

}  // namespace gnomon::app
