#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/progress.h"
#include "common/vec.h"
#include "relief/relief.h"
#include "surface/closed_surface.h"
#include "surface/limit_surface.h"
#include "surface/sample_grid.h"
#include "truth/micro_scene.h"
#include "truth/shadow_tracer.h"

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

/// Which faces continue each other's texture coordinates. Two faces that share an edge do where
/// they agree on its two ends within a thousandth of a texel, or, for a map that repeats, differ by
/// whole maps; and where neither is mirrored beside the other (there the map folds back) nor
/// without area. Every other shared edge is a *seam*. The border of an open surface is none.
class TextureCharts {
 public:
  TextureCharts(const surface::LimitSurface& surface, const relief::Relief& relief);

  /// Shared edges that are seams.
  [[nodiscard]] std::size_t seamCount() const { return seams_; }
  /// Whether the straight line of the map from a sample meets a seam before its end: the line that
  /// tables and marches take the relief from.
  /// @param direction  unit vector in the texture plane
  /// @param length     of the line, texels
  [[nodiscard]] bool crossesSeam(const surface::SurfaceSample& sample, Vec2 direction,
                                 double length) const;

 private:
  enum class Side : std::uint8_t { border, seam, continued };
  /// What lies across one side of a face.
  struct Neighbour {
    Side kind = Side::border;
    surface::FaceSide across{-1, -1};  ///< the common side as the neighbour counts it
    Vec2 shift{0, 0};  ///< the neighbour's texture coordinates less this face's, texels
  };
  struct Face {
    std::array<Vec2, 4> corners;  ///< texels
    std::array<Neighbour, 4> neighbours;
    /// 1 counter-clockwise in the texture plane, -1 mirrored, 0 without area.
    double orientation = 0;
  };

  /// Sets what lies across one side of a face.
  Side connect(const relief::Relief& relief, const surface::FaceSide& side,
               const surface::FaceSide& otherSide);

  std::vector<Face> faces_;
  std::size_t seams_ = 0;
};

/// For every light one byte a sample: 1 where the path to the light crosses a seam, so that part of
/// a method's error there is due to the parametrisation. The path starts at the sample and runs
/// straight over the map toward the light, D = `radiusTexels` at most, and no farther
/// - than to the truth's occluder, where there is one: texels along the light's azimuth at the
///   sample's own metric;
/// - than to where the ray stands higher over the sample's tangent plane than the relief's highest
///   point, where the light arrives.
/// A sample whose own facet is turned from the light has no path, nor has one without a frame.
/// @param truths  of the same samples, one a light
std::vector<std::vector<std::uint8_t>> seamCrossings(
    const surface::LimitSurface& surface, const relief::Relief& relief, const MicroMesh& mesh,
    const MicroScene& scene, const TextureCharts& charts, const surface::SampleGrid& samples,
    std::span<const Truth> truths, std::span<const TraceSettings> lights, double radiusTexels);

/// What tells one cast shadow from another.
struct CastShadowSettings {
  double radiusTexels = 128;        ///< D: farther occluders are `distant`; infinite: none is
  std::span<const int> parts = {};  ///< of every face; empty for a surface of one part
};

/// Splits the region `cast`, as `traceShadows` leaves it, by the first occluder of a sample's ray.
///
/// `distant` is a sample whose occluder is farther than D. How far it stands is measured as the
/// horizon tables do: texels along the light's azimuth, at the sample's own metric.
///
/// `global`, near or far, is a sample whose occluder is not where the path over the surface leads,
/// so that no search along that path, however far, can find it. With Q the occluder, a point of the
/// displaced surface, and P′ the point of the undisplaced surface that Q stands above, a sample is
/// none where the path of SurfacePaths from it passes P′ within
///
///   2 |Q - P′|,
///
/// world units, beside the path's own tolerance. Q lies in the path's plane, but P′, which lies
/// below it along n′, is off it by |Q - P′| sin ψ, where ψ is the angle between n′ and the plane;
/// along the surface the path passes P′ at |Q - P′| tan ψ. The factor 2 is that of ψ = 63°.
/// Limbs that are nearer to each other than this, on one body and turned to the same side, are not
/// told apart.
///
/// Of a surface with parts it also finds the casters.
/// @param truths  of these samples, one a light
/// @param lights  that they were traced with
/// @param placed  the samples on the mesh, where they are known; null where not
void splitCastShadows(const surface::LimitSurface& surface, const relief::Relief& relief,
                      const MicroMesh& mesh, const MicroScene& scene, const SurfacePaths& paths,
                      const CastShadowSettings& settings, const surface::SampleGrid& samples,
                      std::span<const TraceSettings> lights, std::span<Truth> truths,
                      const PlacedSamples* placed = nullptr);

}  // namespace gnomon::truth
