#pragma once

#include <optional>
#include <vector>

#include "common/vec.h"
#include "surface/face_grids.h"
#include "surface/limit_surface.h"

namespace gnomon::truth {

/// How finely the displaced surface is cut.
struct MicroMeshSettings {
  /// Longest micro-edge along a texture axis, texels. Where unset, the largest 1/4, 1/8, 1/12 … of
  /// a texel that gives at least `leastTriangles`.
  std::optional<double> stepTexels;
  double leastTriangles = 4e6;
};

/// The grid lines of a micro-mesh on every face of a surface.
///
/// On a cage that is a regular grid with affine texture coordinates the lines of texel centres are
/// among them: the kinks of the bilinear relief then lie on micro-edges. Elsewhere lines are evenly
/// spaced, so many that no micro-edge along s or t is longer than the step: each edge ring (see
/// edge_rings.h) has the pieces that its longest edge needs, so that a large face gets more than a
/// small one and neighbours still share vertices. No ring has less than a quarter of the pieces of
/// an average face, so that the mesh follows the surface's curvature even where few texels lie on
/// it.
struct MicroLines {
  double askedTexels = 0;                  ///< the step that lines were placed by
  double longestTexels = 0;                ///< the longest micro-edge along s or t, on the map
  std::vector<std::vector<double>> lines;  ///< rising parameters from 0 to 1
  std::vector<surface::FaceLines> faces;   ///< which of them cross each face
};

/// @param texelsPerUv  as in texelFrame
/// @param bytesPerQuad  memory that a micro-quadrilateral will take
/// @throws MemoryError naming `step` where the mesh cannot fit; InputError for a step that is not
///   positive, that needs more lines across a face than Embree's grids can have, or that cannot
///   be found
MicroLines placeMicroLines(const surface::LimitSurface& surface, Vec2 texelsPerUv,
                           const MicroMeshSettings& settings, double bytesPerQuad);

}  // namespace gnomon::truth
