#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon::image {

/// Red, green and blue of 8 bits, sRGB.
using Rgb = std::array<std::uint8_t, 3>;

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

/// A picture of few colours: the place of each pixel's in a list, row by row, row 0 at the top.
struct PaletteImage {
  int width = 0;
  int height = 0;
  std::vector<Rgb> colours;  ///< at most 256
  std::vector<std::uint8_t> values;
};

/// A picture of 16-bit greys, row by row, row 0 at the top.
struct GreyImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint16_t> values;
};

}  // namespace gnomon::image
