#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/light.h"
#include "common/mask.h"
#include "common/progress.h"
#include "common/raw_vector.h"
#include "relief/relief.h"
#include "surface/limit_surface.h"
#include "surface/sample_grid.h"
#include "surface/texel_frame.h"
#include "truth/micro_mesh.h"
#include "truth/micro_scene.h"
#include "truth/region.h"

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
/// @throws MemoryError for places that does not fit in memory
PlacedSamples placeSamples(const surface::LimitSurface& surface, Vec2 texelsPerUv,
                           const MicroMesh& mesh, const surface::SampleGrid& samples,
                           const Progress& progress = {});

constexpr std::uint8_t noCaster = 255;

/// The exact answer for every sample of a view under one light.
struct Truth {
  /// Of a light with a disc, once `answerBy` has set it: where less than half of it is seen.
  Mask mask;
  /// One a sample. `cast` is whatever an occluder shades this side of the terminator, until
  /// `splitCastShadows` finds the regions `distant` and `global` among it.
  std::vector<Region> regions;
  std::size_t undefinedSamples = 0;  ///< samples without a frame: Shade::none in the mask
  /// One a sample, 1 where its path to the light crosses a texture seam; empty before
  /// `seamCrossings` fills it.
  std::vector<std::uint8_t> crossesSeam = {};
  /// One a sample of a surface with parts: the part of the first occluder, where a shadow is cast,
  /// else `noCaster`. Empty before `splitCastShadows` fills it, and for a surface of one part.
  std::vector<std::uint8_t> casters = {};
  /// Of a light with a disc: the share that each sample sees. Empty of a point light. The regions
  /// are those of the hard shadow to the disc's centre.
  Visibility visibility = {};

  [[nodiscard]] bool isSoft() const { return visibility.size() > 0; }
  /// Sets the shares, and the mask that they are cut to.
  void answerBy(Visibility shares);
};

/// The shadow rays of one trace.
struct TraceSettings {
  Light light = {};
  /// How far over its facet a ray starts, as a share of the mesh's largest coordinate.
  double rayOffset = standardRayOffset;
};

/// Traces one shadow ray a sample. A ray starts on the facet that holds the sample's displaced
/// point (known from (s, t)), a little off it (Facet::rayOrigin); a facet turned from the light is
/// shadowed without a ray.
/// Results do not depend on the number of threads, nor on which other samples are traced with one.
/// @param placed    on the mesh of the scene
/// @param progress  may throw to cancel, see common/progress.h
Truth traceShadows(const MicroScene& scene, const PlacedSamples& placed,
                   const TraceSettings& settings, const Progress& progress = {});

/// The same for several lights at once, without holding the samples' places: each is found once,
/// whatever the number of lights.
/// @returns one truth a light
std::vector<Truth> traceShadows(const surface::LimitSurface& surface, const relief::Relief& relief,
                                const MicroMesh& mesh, const MicroScene& scene,
                                const surface::SampleGrid& samples,
                                std::span<const TraceSettings> lights,
                                const Progress& progress = {});

/// The same for one light.
Truth traceShadows(const surface::LimitSurface& surface, const relief::Relief& relief,
                   const MicroMesh& mesh, const MicroScene& scene,
                   const surface::SampleGrid& samples, const TraceSettings& settings,
                   const Progress& progress = {});

/// Share of the samples that both masks hold and on which they differ: the truth's own error,
/// where one mask was traced at half the resolution of the other. 0 where there is no sample.
double flipRate(const Mask& a, const Mask& b);

/// The point that blocks the light of one sample.
struct Occluder {
  Vec3 point;       ///< world; where the ray first meets the displaced surface
  double distance;  ///< world length of the ray from where it starts to there
  bool attached;    ///< the sample's own facet is turned from the light: no ray, distance 0
};

/// The shadow ray that `traceShadows` traces for a sample.
struct OccluderQuery {
  surface::SurfaceSample sample;
  Vec3 light{0, 0, 1};                   ///< unit vector toward the directional light
  double rayOffset = standardRayOffset;  ///< as in TraceSettings
};

/// The first occluder of a sample's shadow ray; none where it is lit, or has no frame. There is one
/// exactly where `traceShadows` says shadowed.
std::optional<Occluder> firstOccluder(const surface::LimitSurface& surface,
                                      const relief::Relief& relief, const MicroMesh& mesh,
                                      const MicroScene& scene, const OccluderQuery& query);

}  // namespace gnomon::truth
