#pragma once

#include <cstddef>
#include <vector>

#include "surface/limit_surface.h"

namespace gnomon::surface {

/// Which edges of a surface's faces must be cut into the same number of pieces, if every face is to
/// be a grid and neighbours are to share the vertices of their common edge. An edge ring is an
/// edge, the edge opposite to it in each face that it belongs to, the edges opposite to those in
/// the next faces, and so on. A ring ends at a border of the surface or closes on itself, and it
/// may run through a face twice.
struct EdgeRings {
  /// The rings of one face.
  struct Face {
    int s;  ///< of the edges along s: t = 0 and t = 1
    int t;  ///< of the edges along t: s = 0 and s = 1
  };
  std::vector<Face> faces;
  int count = 0;  ///< number of rings; they are numbered by the first face that has them
};

EdgeRings makeEdgeRings(const LimitSurface& surface);

}  // namespace gnomon::surface
