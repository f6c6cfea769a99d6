#pragma once

#include <vector>

#include "surface/limit_surface.h"

namespace gnomon::surface {

/// Whether every edge of the surface has a face on both sides: it has no border.
bool isClosed(const LimitSurface& surface);

/// The volume inside a closed surface, cubic world units, below 0 where its faces run clockwise
/// seen from outside, so that its normals point inward: a surface inside out. Computed for the
/// polyhedron whose triangles join each face's middle to its four edges.
double enclosedVolume(const LimitSurface& surface);

/// Side k of a face runs from its corner k to corner (k + 1) % 4: along s at t = 0, along t at s =
/// 1, back along s at t = 1, back along t at s = 0.
struct FaceSide {
  int face, side;
};

/// An edge of the cage that two faces have: side `first` of the face with the lower number, and
/// side `second` of the other one. The two sides run in opposite directions.
struct SharedSide {
  FaceSide first, second;
};

/// All edges with a face on both sides, by their cage vertices. An edge with one face is the
/// surface's border and is not listed; nor is one of polygons where more than two meet, or two that
/// run along it in the same direction.
std::vector<SharedSide> sharedSides(const LimitSurface& surface);

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
