#pragma once

#include "surface/limit_surface.h"

namespace gnomon::surface {

/// The size of one face on the map.
struct FaceTexels {
  double s;     ///< the longest line along s, texels
  double t;     ///< the longest line along t, texels
  double area;  ///< square texels
};

/// Texture coordinates are bilinear on a face, so that the longest line along s or t is an edge.
/// @param texelsPerUv  as in texelFrame
FaceTexels faceTexels(const LimitSurface& surface, Vec2 texelsPerUv, int face);

/// The longest edge of any face, texels.
double longestEdgeTexels(const LimitSurface& surface, Vec2 texelsPerUv);

}  // namespace gnomon::surface
