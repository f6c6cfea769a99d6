#pragma once

#include "relief/height_field.h"

namespace gnomon::relief {

/// A polished surface with scratches: straight grooves at random places, in random directions. At a
/// texel the height is 1 less the deepest groove there; with r the distance to a scratch's segment
/// its groove is
///   depth · (1 - (2r / width)²), at least 0: a parabola across, rounded at the ends.
/// There are n = round(density · width of the map · height of the map / (⅝ · length · width)) of
/// them, at least one. Scratch i of n, from 0, has depth 1 - ¾ i/n; middle, direction and length,
/// from ¼ to 1 of `length`, are uniformly random from `seed`. The map tiles whatever its sides are.
struct ScratchesPattern {
  double density = 0.3;  ///< share of the map that they would cover if they did not overlap
  double length = 64;    ///< texels: of the longest
  double width = 6;      ///< texels
  int seed = 1;          ///< 0 or more
};

/// @throws InputError naming the key: a length under a texel or over 16,384, a density that is not
///   above 0 or over 4; MemoryError
HeightField makeScratches(int width, int height, const ScratchesPattern&, double amplitude, Wrap);

}  // namespace gnomon::relief
