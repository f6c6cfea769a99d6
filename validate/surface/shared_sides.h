#pragma once

#include <cstddef>
#include <vector>

#include "surface/limit_surface.h"

namespace gnomon::surface {

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
/// surface's border and is not listed.
std::vector<SharedSide> sharedSides(const LimitSurface& surface);

}  // namespace gnomon::surface
