#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "relief/height_field.h"

namespace gnomon {

/// A height map with margins of ⌈D⌉ + 2 texels that the wrap rule filled, so that no ray of length
/// D from a texel leaves it. Texel (i, j) of the map lies at (margin + i, margin + j). Heights are
/// height units above the middle of the map's range: floats are finest there.
struct PaddedMap {
  static constexpr int blockShift = 4;  ///< log2 of the side of a block

  std::ptrdiff_t stride = 0;  ///< texels from one row to the next
  std::ptrdiff_t rows = 0;
  std::ptrdiff_t margin = 0;
  std::vector<float> heights;
  /// h00 - h10 - h01 + h11 of the cell right of and above each texel: what bends a ray's profile.
  std::vector<float> twists;
  std::ptrdiff_t blockStride = 0;
  std::vector<float> blockMaxima;  ///< highest texel of each square block
  float maximum = 0;               ///< highest texel
  /// 2⁻²⁰ (highest - lowest). Slopes count as equal unless they differ by more than this over the
  /// distance of the nearer one: about the sum of the roundings that either may have suffered.
  /// Without it a plane's horizon would move to wherever the roundings happen to be favourable.
  double tolerance = 0;
};

/// A rectangle of texels of a padded map, its edges included.
struct TexelBox {
  std::ptrdiff_t left, bottom, right, top;
};

/// @param radius  D > 0, texels; @param overhang  texels that a row is longer than it need be, so
///   that whole vectors can be read at its end
PaddedMap padMap(const HeightField& field, double radius, int overhang);

/// Memory that `padMap` takes, bytes.
double paddedMapBytes(const HeightField& field, double radius, int overhang);

/// A bound on the texels in the box: the maximum over all blocks that it meets. Defined here since
/// the baker's loop wants it inline.
inline float highestIn(const PaddedMap& map, const TexelBox& box) {
  constexpr int shift = PaddedMap::blockShift;
  float highest = -std::numeric_limits<float>::infinity();
  for (std::ptrdiff_t by = box.bottom >> shift; by <= box.top >> shift; ++by) {
    const float* maxima = map.blockMaxima.data() + by * map.blockStride;
    for (std::ptrdiff_t bx = box.left >> shift; bx <= box.right >> shift; ++bx) {
      highest = std::max(highest, maxima[bx]);
    }
  }
  return highest;
}

}  // namespace gnomon
