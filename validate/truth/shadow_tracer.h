#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/light.h"
#include "common/mask.h"
#include "common/progress.h"
#include "relief/relief.h"
#include "surface/limit_surface.h"
#include "surface/sample_grid.h"
#include "truth/micro_mesh.h"
#include "truth/micro_scene.h"
#include "truth/region.h"
#include "truth/sample_place.h"

namespace gnomon::truth {

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
