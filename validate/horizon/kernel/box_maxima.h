#pragma once

#include <cstddef>

#include "common/raw_vector.h"
#include "horizon/kernel/padded_map.h"

namespace gnomon::horizon {

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
