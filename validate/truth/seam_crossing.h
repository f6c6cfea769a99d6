#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/progress.h"
#include "relief/relief.h"
#include "surface/limit_surface.h"
#include "surface/sample_grid.h"
#include "surface/shared_sides.h"
#include "truth/micro_scene.h"
#include "truth/shadow_tracer.h"

namespace gnomon::truth {

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

}  // namespace gnomon::truth
