#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "surface/cage/cage.h"
#include "surface/limit_surface.h"

namespace gnomon::surface {

/// The faces of a cage of scheme `none`, evaluated: P bilinear between the corners, and so linear
/// on a triangle's three faces; normal of shading N and direction of displacement d bilinear, then
/// of length 1. The displaced surface is P + h d, while methods shade and see the light by N.
///
/// The curvature of such a surface is the turn of N: polygons are flat or nearly so, and N is what
/// stands for the body that they mean. It is 0 where a file's normals are the polygons' own.
class PolygonSurface {
 public:
  explicit PolygonSurface(const Cage& cage);

  /// Without texture coordinates; 0 ≤ s, t ≤ 1.
  [[nodiscard]] TangentPoint tangentPoint(std::size_t face, double s, double t) const;
  [[nodiscard]] LimitPoint evaluate(std::size_t face, double s, double t) const;

 private:
  using Corners = std::array<int, 4>;  ///< at (0, 0), (1, 0), (1, 1), (0, 1)

  std::vector<Vec3> positions_, directions_, normals_;
  std::vector<Corners> faceVertices_, faceNormals_;
};

}  // namespace gnomon::surface
