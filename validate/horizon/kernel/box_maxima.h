#pragma once

#include <cstddef>

#include "common/raw_vector.h"
#include "horizon/kernel/padded_map.h"

namespace gnomon {

/// Width and height of a rectangle of nodes.
struct BoxSize {
  int width = 1, height = 1;
  // NOLINTNEXTLINE(modernize-use-nullptr): it takes the comparison's own 0 for a pointer
  auto operator<=>(const BoxSize&) const = default;
};

/// For each texel of a padded map the highest of the box of nodes whose lower left one it is: a
/// bound on what a part of a ray meets, for many neighbouring rays in one load. Of 2^rowShift rows
/// one is kept, whose boxes are as much higher and so hold those of all these rows.
struct BoxMaxima {
  BoxSize box;
  int rowShift = 0;
  RawVector<float> highest;  ///< [row >> rowShift][column], rows as long as the map's
};

/// The map's own heights as boxes of one node, to start from; then larger boxes from smaller ones.
/// @param box  at least that of `from`
BoxMaxima boxMaxima(const PaddedMap& map, BoxSize box, int rowShift);
BoxMaxima boxMaxima(const PaddedMap& map, const BoxMaxima& from, BoxSize box, int rowShift);

}  // namespace gnomon
