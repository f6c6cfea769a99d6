#pragma once

#include "surface/limit_surface.h"
#include "surface/sample_grid.h"
#include "truth/micro_mesh.h"

namespace gnomon {

/// Where the truth answers for one sample, in world coordinates: its shadow ray starts at `point`
/// and its facet is turned from the light where `facetNormal` · L ≤ 0.
struct SamplePlace {
  bool defined = false;  ///< false where the truth has no answer: then all else is zero
  Vec3 base{0};          ///< P, on the undisplaced limit surface
  Vec3 normal{0};        ///< n there, unit, outward
  Vec2 texel{0};         ///< texture coordinates, texels
  Vec3 point{0};         ///< on the facet of the micro-mesh above it: D, but for the mesh's step
  Vec3 facetNormal{0};   ///< of that facet, unit, outward
};

/// @param texelsPerUv  as in texelFrame
SamplePlace samplePlace(const LimitSurface& surface, Vec2 texelsPerUv, const MicroMesh& mesh,
                        const SurfaceSample& sample);

}  // namespace gnomon
