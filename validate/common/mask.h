#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

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

}  // namespace gnomon
