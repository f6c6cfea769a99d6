#include "surface/closed_surface.h"

#include <array>
#include <cstddef>

#include "surface/shared_sides.h"

namespace gnomon::surface {

bool isClosed(const LimitSurface& surface) {
  return 2 * sharedSides(surface).size() == 4 * static_cast<std::size_t>(surface.faceCount());
}

double enclosedVolume(const LimitSurface& surface) {
  // By the divergence theorem: a sixth of the triple products of all triangles' corners. A nearby
  // origin keeps them exact.
  const Vec3 origin = surface.tangentPoint(0, 0, 0).position;
  double sixfold = 0;
  for (int face = 0; face < surface.faceCount(); ++face) {
    const auto at = [&](double s, double t) {
      return surface.tangentPoint(face, s, t).position - origin;
    };
    const Vec3 middle = at(0.5, 0.5);
    const std::array corners = {at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
    for (std::size_t k = 0; k < 4; ++k) {
      sixfold += glm::dot(middle, glm::cross(corners.at(k), corners.at((k + 1) % 4)));
    }
  }
  return sixfold / 6;
}

}  // namespace gnomon::surface
