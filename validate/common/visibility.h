#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "common/mask.h"

namespace gnomon {

/// What a visibility map holds where there is no sample.
constexpr float noSample = std::numeric_limits<float>::quiet_NaN();

/// V, the share of the light's disc that a point sees, for all samples of a view, row by row, row 0
/// at the top of the picture: 0 where the point is in umbra, 1 where it sees the whole disc,
/// between them in penumbra, `noSample` where there is no sample. Uniform over the disc's solid
/// angle.
struct Visibility {
  int width = 0;
  int height = 0;
  std::vector<float> shares;

  [[nodiscard]] std::size_t size() const { return shares.size(); }
};

/// A mask's answers as shares: 1 where lit, 0 where shadowed.
Visibility asShares(const Mask& mask);

/// Whether two maps hold the same shares at the same samples.
bool isSame(const Visibility& a, const Visibility& b);

/// The mask that a map is cut to where an answer must be hard: shadowed where V < 1/2, where less
/// than half of the disc is seen. A penumbra whose V falls evenly is cut in two halves of equal
/// area.
Mask cutInHalf(const Visibility& map);

}  // namespace gnomon
