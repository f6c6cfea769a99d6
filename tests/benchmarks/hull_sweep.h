#pragma once

#include <vector>

#include "common/vec.h"
#include "relief/height_field.h"

namespace gnomon::benchmarks {

/// Horizons of one azimuth along shared lines (V. Timonen, J. Westerholm. Scalable height field
/// self-shadowing. Computer Graphics Forum 29(2), 2010): the fastest of the known ways, and not
/// exact. Texels are taken to lie on the nearest of parallel lines, a texel apart across the map's
/// columns; a line is sampled once a column, linearly between two texels, and followed against the
/// direction while the upper convex hull of what is behind is kept: the horizon is the tangent to
/// it.
struct HullHorizons {
  std::vector<float> slope;     ///< [y][x], height units per texel: the tangent of the horizon
  std::vector<float> distance;  ///< [y][x], texels
};

/// Sees as far as the map is wide, or farther.
/// @param field      repeats
/// @param direction  unit, in the first octant: x ≥ y ≥ 0
HullHorizons sweepHulls(const relief::HeightField& field, Vec2 direction);

}  // namespace gnomon::benchmarks
