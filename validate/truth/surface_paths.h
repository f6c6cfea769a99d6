#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/vec.h"
#include "surface/limit_surface.h"
#include "surface/surface_sample.h"

namespace gnomon::truth {

/// The way from a point of the undisplaced surface toward a light.
struct PathStart {
  surface::SurfaceSample sample;
  Vec3 normal;  ///< n there, unit, outward
  Vec3 light;   ///< L, unit vector toward the light
};

/// Another point of the undisplaced surface.
struct PathTarget {
  Vec3 point;
  Vec3 normal;  ///< unit, outward
  int face;
  double reach;  ///< how far from the path it may lie, world units
};

/// Where the path under the ray to a light leads over a surface. The *path* is the surface's
/// section with the plane of n and L through a point: from there toward the light, up to the
/// surface's border, and no farther than its tangent has come away from e = L - (L·n) n by a
/// quarter turn: there it no longer runs under the ray. To third order in its length it is the
/// geodesic that methods march along (see shaders/common/path.glsl, which end it at a quarter turn
/// too).
///
/// It is followed over a mesh of triangles on the limit surface, at least 2¹⁷ of them, or two a
/// face. Faces continue each other where they share an edge of the cage, whatever their texture
/// coordinates.
class SurfacePaths {
 public:
  explicit SurfacePaths(const surface::LimitSurface& surface);

  /// Whether the path passes a target within its reach and one triangle's longest side (by which
  /// the mesh may be beside the surface), where the surface faces the target's side: n·n′ ≥ 0. A
  /// light along the normal has a path that goes nowhere.
  [[nodiscard]] bool leadTo(const PathStart& start, const PathTarget& target) const;

  /// What it takes in memory.
  [[nodiscard]] std::uint64_t byteCount() const {
    return points_.size() * sizeof(Vec3) +
           (triangles_.size() + neighbours_.size() + pieces_.size()) * sizeof(Index);
  }

 private:
  using Index = std::uint32_t;
  struct Place {
    std::size_t triangle;
    Vec3 point;
  };

  void placeVertices(const surface::LimitSurface& surface);
  void connect();
  void labelPieces();
  [[nodiscard]] const Vec3& corner(std::size_t triangle, std::size_t k) const {
    return points_[triangles_[3 * triangle + k % 3]];
  }
  [[nodiscard]] Place placeOf(const surface::SurfaceSample& sample) const;
  /// Whether a straight part of a path in one triangle passes the target.
  [[nodiscard]] bool passes(std::size_t triangle, const Vec3& from, const Vec3& to,
                            const PathTarget& target) const;

  int cells_;  ///< along each side of a face
  std::vector<Vec3> points_;
  std::vector<Index> triangles_;   ///< three vertices each
  std::vector<Index> neighbours_;  ///< 3 × triangle + side across each side, or none
  std::vector<Index> pieces_;      ///< one a triangle: equal where the surface connects them
  double longest_ = 0;             ///< side of a triangle
};

}  // namespace gnomon::truth
