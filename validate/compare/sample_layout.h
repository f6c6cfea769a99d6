#pragma once

#include <cstdint>
#include <vector>

namespace gnomon::compare {

/// How the samples of a view lie beside each other. As it stands: an image, measured in pixels.
struct SampleLayout {
  double columnStep = 1;  ///< from a column to the next, in the view's unit: pixels or texels
  double rowStep = 1;     ///< from a row to the next, in that unit
  /// Side, in samples, of the square tiles of an atlas in which neighbours in the picture are none
  /// on the surface, once they are in different tiles. 0 where there are none.
  int tileSide = 0;
  /// One a sample: the neighbours from which a break in the surface parts it, as at the contour of
  /// a fold. A sum of `breakRight` and `breakBelow`. Empty where the surface has none.
  std::vector<std::uint8_t> breaks;
};

constexpr std::uint8_t breakRight = 1;  ///< between a sample and the one to its right
constexpr std::uint8_t breakBelow = 2;  ///< between a sample and the one below

}  // namespace gnomon::compare
