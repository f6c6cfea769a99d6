#pragma once

#include <optional>

#include "relief/relief.h"
#include "surface/limit_surface.h"
#include "surface/sample_grid.h"
#include "truth/micro_mesh.h"
#include "truth/micro_scene.h"
#include "truth/shadow_tracer.h"

namespace gnomon::truth {

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
