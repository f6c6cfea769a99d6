#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

#include "common/vec.h"

namespace gnomon {

/// What a mask says of one sample.
enum class Shade : std::uint8_t {
  lit = 0,
  shadowed = 1,
  none = 2,  ///< no sample here: background, or a point where no frame exists
};

/// The answers of one method (or of the truth) for all samples of a view, row by row, row 0 at the
/// top of the picture.
struct Mask {
  int width = 0;
  int height = 0;
  std::vector<Shade> samples;

  [[nodiscard]] std::size_t size() const { return samples.size(); }
};

/// Whether two masks hold the same answers at the same samples. By bytes: the standard library
/// compares a vector of an enumeration one by one.
inline bool isSame(const Mask& a, const Mask& b) {
  static_assert(sizeof(Shade) == 1);
  return a.width == b.width && a.height == b.height && a.size() == b.size() &&
         (a.size() == 0 || std::memcmp(a.samples.data(), b.samples.data(), a.size()) == 0);
}

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

/// Samples of a mask as four a byte, the first in the lowest bits; the last byte is filled up with
/// lit ones.
std::vector<std::uint8_t> packedShades(std::span<const Shade> samples);

/// The first `count` samples of such bytes; fewer where there are not so many.
std::vector<Shade> unpackedShades(std::span<const std::uint8_t> packed, std::size_t count);

/// V of a light's disc whose centre stands x of its radii over a straight horizon:
/// 1 - (acos x - x √(1 - x²)) / π for -1 < x < 1, else 0 or 1. A flat disc's, the limit of small
/// radii: of a radius of 5° it is within 0.002 of a cap's solid angle.
inline double discShare(double x) {
  const double within = std::clamp(x, -1.0, 1.0);
  return 1 - (std::acos(within) - within * std::sqrt(1 - within * within)) / pi;
}

}  // namespace gnomon
