#pragma once

#include <vector>

#include "common/progress.h"
#include "surface/limit_surface.h"
#include "surface/sample_grid.h"
#include "surface/texel_frame.h"
#include "truth/micro_mesh.h"

namespace gnomon {

/// Where the truth answers for one sample: its shadow rays start on `facet`, which is turned from a
/// light where its normal · L ≤ 0. Nothing here depends on a light.
struct SamplePlace {
  SurfaceSample sample;
  bool defined = false;  ///< false where the truth has no answer: then what follows means nothing
  TexelFrame frame;      ///< of the undisplaced limit surface, world coordinates
  Facet facet;           ///< of the micro-mesh above it, coordinates relative to the mesh's centre
};

/// @param texelsPerUv  as in texelFrame
SamplePlace samplePlace(const LimitSurface& surface, Vec2 texelsPerUv, const MicroMesh& mesh,
                        const SurfaceSample& sample);

/// The samples of a view, or of a part of one, with their places: what all lights share.
struct PlacedSamples {
  int width = 0;
  int height = 0;
  std::vector<SamplePlace> places;  ///< row by row, as in the SampleGrid that they were made from
  double extent = 0;                ///< of the mesh that they are on, see MicroMesh::extent
};

/// Places samples on a micro-mesh, for lights that come one after the other.
/// @param progress  may throw to cancel, see common/progress.h
/// @throws MemoryError for places that cannot be held
PlacedSamples placeSamples(const LimitSurface& surface, Vec2 texelsPerUv, const MicroMesh& mesh,
                           const SampleGrid& samples, const Progress& progress = {});

}  // namespace gnomon
