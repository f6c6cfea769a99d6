#pragma once

#include <compare>

#include "render/method.h"
#include "surface/base_mesh.h"

namespace gnomon {

/// Which mesh: the base mesh or the displaced one, of so many pieces of every face's side.
struct MeshChoice {
  DrawnMesh kind = DrawnMesh::base;
  int subdivisions = 1;
  CurvatureSource curvature = CurvatureSource::limit;

  // NOLINTNEXTLINE(modernize-use-nullptr): it takes the comparison's own 0 for a pointer
  friend auto operator<=>(const MeshChoice&, const MeshChoice&) = default;
};

}  // namespace gnomon
