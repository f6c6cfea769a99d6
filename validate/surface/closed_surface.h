#pragma once

#include "surface/limit_surface.h"

namespace gnomon::surface {

/// Whether every edge of the surface has a face on both sides: it has no border.
bool isClosed(const LimitSurface& surface);

/// The volume inside a closed surface, cubic world units, below 0 where its faces run clockwise
/// seen from outside, so that its normals point inward: a surface inside out. Computed for the
/// polyhedron whose triangles join each face's middle to its four edges.
double enclosedVolume(const LimitSurface& surface);

}  // namespace gnomon::surface
