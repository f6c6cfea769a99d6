#pragma once

#include <cstddef>

#include "common/raw_vector.h"
#include "horizon/reference.h"
#include "relief/height_field.h"

namespace gnomon::horizon {

/// A height map with margins that the wrap rule filled, so that every node of a ray of length D
/// from any texel lies in it at one and the same offset from that texel. Texel (i, j) of the map
/// lies at (marginX + i, marginY + j). Heights are height units above the middle of the map's
/// range: floats are finest there.
///
/// Past a border the first line of nodes holds what the wrap rule says: between it and the map's
/// outermost nodes lies the border. All nodes beyond it lie 2¹² times the map's range below it: a
/// ray falls there at once, so that no slope past that line exceeds the slope at it, and rays need
/// no ends of their own. That holds for directions that are at least 1e-3 from parallel to the
/// border, or parallel to it, as with up to 1,500 azimuths all are. The half texel past the border
/// is too much: `bakeTiles` looks again at the rays whose horizon lies in it.
///
/// Margins are ⌈D⌉ + 2 texels. An axis that repeats without a border never needs more than half its
/// side: offsets are taken modulo the side (`offset`), so that the map does not grow with the
/// radius any more.
struct PaddedMap {
  int width = 0, height = 0;              ///< of the map itself
  bool repeatsX = true, repeatsY = true;  ///< without a border
  std::ptrdiff_t stride = 0;              ///< texels from one row to the next
  std::ptrdiff_t rows = 0;
  std::ptrdiff_t marginX = 0, marginY = 0;
  RawVector<float> heights;
  /// h00 - h10 - h01 + h11 of the cell right of and above each texel: what bends a ray's profile.
  /// 0 in a cell past two borders, whose one known corner is a ray's last known point.
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
PaddedMap padMap(const relief::HeightField& field, double radius);

/// Memory that `padMap` takes, bytes.
double paddedMapBytes(const relief::HeightField& field, double radius);

/// Width and height of a rectangle of nodes.
struct BoxSize {
  int width = 1, height = 1;
  // NOLINTNEXTLINE(modernize-use-nullptr): it takes the comparison's own 0 for a pointer
  auto operator<=>(const BoxSize&) const = default;
};

/// For each texel of a padded map the highest node of the box of nodes whose lower left one it is:
/// an upper bound on the heights that a part of a ray meets, for many neighbouring rays in one
/// load. One of 2^rowShift rows is kept; its boxes are so much taller that they contain those of
/// the rows left out.
struct BoxMaxima {
  BoxSize box;
  int rowShift = 0;
  RawVector<float> highest;  ///< [row >> rowShift][column], rows as long as the map's
};

/// The map's own heights as boxes of one node, to start from; then larger boxes from smaller ones.
/// @param box  at least that of `from`
BoxMaxima boxMaxima(const PaddedMap& map, BoxSize box, int rowShift);
BoxMaxima boxMaxima(const PaddedMap& map, const BoxMaxima& from, BoxSize box, int rowShift);

}  // namespace gnomon::horizon
