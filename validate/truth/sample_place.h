#pragma once

#include <optional>
#include <span>

#include "common/progress.h"
#include "common/raw_vector.h"
#include "surface/limit_surface.h"
#include "surface/sample_grid.h"
#include "surface/texel_frame.h"
#include "truth/micro_mesh.h"

namespace gnomon::truth {

/// A sample on the displaced surface, whatever the light: its shadow rays start on `facet`.
struct SamplePlace {
  surface::SurfaceSample sample;
  bool defined = false;  ///< false where the truth has no answer: frame and facet mean nothing then
  surface::TexelFrame frame;  ///< of the undisplaced limit surface, world coordinates
  Facet facet;  ///< of the micro-mesh above it, coordinates relative to the mesh's centre
};

/// Finds the places of samples, one after the other, on one thread. It keeps the last sample's face
/// prepared, since neighbours mostly lie on the same face.
class SamplePlacer {
 public:
  /// @param surface, mesh  outlive this
  /// @param texelsPerUv    as in texelFrame
  SamplePlacer(const surface::LimitSurface& surface, Vec2 texelsPerUv, const MicroMesh& mesh)
      : surface_(surface), texelsPerUv_(texelsPerUv), mesh_(mesh) {}

  [[nodiscard]] SamplePlace place(const surface::SurfaceSample& sample);

 private:
  const surface::LimitSurface& surface_;
  Vec2 texelsPerUv_;
  const MicroMesh& mesh_;
  int lastFace_ = -1;
  std::optional<surface::LimitFace> face_;
};

/// The part of a SamplePlace that every shadow ray needs.
struct RayStart {
  Facet facet;   ///< see SamplePlace
  Vec3 normal;   ///< n of the undisplaced surface, unit, outward
  bool defined;  ///< see SamplePlace
};

RayStart rayStart(const SamplePlace& place);

/// P_x and P_y at a sample, to measure the length of a ray in texels.
struct TexelAxes {
  Vec3 px, py;
};

/// Length of a ray whose trace on the tangent plane is so many texels long, world units:
/// texels · w / |L - (L·n) n|, where w is the world length of a texel along the trace. Infinite for
/// a light at the zenith.
/// @param normal  of the undisplaced surface, unit
/// @param light   unit vector toward it
double rayLength(const Vec3& normal, const TexelAxes& axes, const Vec3& light, double texels);

/// The samples of a view placed on a micro-mesh, for any number of lights. 128 bytes a sample, in
/// the order of the SampleGrid.
struct PlacedSamples {
  int width = 0;
  int height = 0;
  RawVector<RayStart> starts;
  RawVector<TexelAxes> axes;
  double extent = 0;          ///< of the mesh, see MicroMesh::extent
  std::size_t undefined = 0;  ///< samples on the surface for which the truth has no answer
};

/// Places samples on this thread.
/// @param starts  as many as there are samples
/// @param axes    as many, or none
/// @returns how many of them lie on the surface but have no answer of the truth
std::size_t placeSamples(SamplePlacer& placer, std::span<const surface::SurfaceSample> samples,
                         std::span<RayStart> starts, std::span<TexelAxes> axes = {});

/// Places samples on a micro-mesh, for lights that come one after the other.
/// @param progress  may throw to cancel, see common/progress.h
/// @throws MemoryError for places that cannot be held
PlacedSamples placeSamples(const surface::LimitSurface& surface, Vec2 texelsPerUv,
                           const MicroMesh& mesh, const surface::SampleGrid& samples,
                           const Progress& progress = {});

}  // namespace gnomon::truth
