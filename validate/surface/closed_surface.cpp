#include "surface/closed_surface.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace gnomon {

bool isClosed(const LimitSurface& surface) {
  std::map<std::pair<int, int>, int> faces;
  for (int face = 0; face < surface.faceCount(); ++face) {
    const std::array<int, 4> corners = surface.corners(face);
    for (std::size_t k = 0; k < 4; ++k)
      ++faces[std::minmax(corners.at(k), corners.at((k + 1) % 4))];
  }
  return std::all_of(faces.begin(), faces.end(), [](const auto& edge) { return edge.second == 2; });
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

}  // namespace gnomon
