#pragma once

#include <cstddef>

#include "displaced/welded_mesh.h"
#include "study/run/scene/run_scene.h"
#include "truth/micro_mesh.h"

namespace gnomon::exporting {

/// How far the exported mesh is from the truth's: between the two points above the same (face, s,
/// t), over the samples of all views of the standard base.
struct MeshDistance {
  std::size_t samples = 0;
  double largest = 0, mean = 0;              ///< world length
  double largestTexels = 0, meanTexels = 0;  ///< over a texel's length there, |P_x × P_y|^½
};

/// @param pieces  subdivisions of the exported mesh
MeshDistance meshDistance(study::RunScene& scene, const truth::MicroMesh& truth,
                          const displaced::WeldedMesh& exported, int pieces);

}  // namespace gnomon::exporting
