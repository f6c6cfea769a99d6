#pragma once

#include <span>

#include "relief/relief.h"
#include "surface/limit_surface.h"
#include "surface/sample_grid.h"
#include "truth/micro_scene.h"
#include "truth/sample_place.h"
#include "truth/shadow_tracer.h"
#include "truth/surface_paths.h"

namespace gnomon::truth {

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
