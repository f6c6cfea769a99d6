#pragma once

#include <cstddef>

#include "common/raw_vector.h"
#include "relief/height_field.h"
#include "relief/ray_crossings.h"

namespace gnomon {

/// A height map with margins that the wrap rule filled, so that every node of a ray of length D
/// from any texel lies in it at one and the same offset from that texel. Texel (i, j) of the map
/// lies at (marginX + i, marginY + j). Heights are height units above the middle of the map's
/// range: floats are finest there.
///
/// Margins are ⌈D⌉ + 2 texels. A map that repeats never needs more than half its side: offsets are
/// taken modulo the side (`offset`), so that its size does not grow with the radius any more.
struct PaddedMap {
  int width = 0, height = 0;  ///< of the map itself
  Wrap wrap = Wrap::repeat;
  std::ptrdiff_t stride = 0;  ///< texels from one row to the next
  std::ptrdiff_t rows = 0;
  std::ptrdiff_t marginX = 0, marginY = 0;
  RawVector<float> heights;
  /// h00 - h10 - h01 + h11 of the cell right of and above each texel: what bends a ray's profile.
  RawVector<float> twists;
  float maximum = 0;  ///< highest texel
  float lowestTwist = 0, highestTwist = 0;
  /// 2⁻²⁰ (highest - lowest): slopes count as equal unless they differ by more than this over their
  /// distance, about the sum of the roundings that either may have suffered. Without it a plane's
  /// horizon would move to wherever the roundings happen to be favourable.
  float tolerance = 0;

  /// Where a node relative to any texel lies: in the margins, or a period away from there.
  [[nodiscard]] Node folded(Node node) const;
  /// The same as an offset into `heights`.
  [[nodiscard]] std::ptrdiff_t offset(Node node) const {
    const Node n = folded(node);
    return n.y * stride + n.x;
  }
};

/// @param radius  D > 0, texels
PaddedMap padMap(const HeightField& field, double radius);

/// Memory that `padMap` takes, bytes.
double paddedMapBytes(const HeightField& field, double radius);

}  // namespace gnomon
