#include "surface/face_texels.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::surface {

FaceTexels faceTexels(const LimitSurface& surface, Vec2 texelsPerUv, int face) {
  const auto at = [&](double s, double t) {
    return surface.tangentPoint(face, s, t).uv * texelsPerUv;
  };
  const std::array corners = {at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
  const auto edge = [&](std::size_t from, std::size_t to) {
    return glm::length(corners.at(to) - corners.at(from));
  };
  const Vec2 a = corners[2] - corners[0];
  const Vec2 b = corners[3] - corners[1];
  return {std::max(edge(0, 1), edge(3, 2)), std::max(edge(0, 3), edge(1, 2)),
          std::abs(a.x * b.y - a.y * b.x) / 2};
}

double longestEdgeTexels(const LimitSurface& surface, Vec2 texelsPerUv) {
  double longest = 0;
  for (int face = 0; face < surface.faceCount(); ++face) {
    const FaceTexels size = faceTexels(surface, texelsPerUv, face);
    longest = std::max({longest, size.s, size.t});
  }
  return longest;
}

}  // namespace gnomon::surface
