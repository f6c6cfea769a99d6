#pragma once

#include <cstdint>
#include <vector>

namespace gnomon::image {

/// A picture of 8-bit sRGB values: three a pixel, row by row, row 0 at the top.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
};

/// A picture of 8-bit greys, row by row, row 0 at the top.
struct ByteImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> values;
};

/// A picture of 16-bit greys, row by row, row 0 at the top.
struct GreyImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint16_t> values;
};

}  // namespace gnomon::image
