#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::report {

/// A square of a picture, its corner at the left top.
struct Window {
  int left = 0, top = 0;
  int side = 0;           ///< pixels
  std::size_t wrong = 0;  ///< pixels in it that are wrong
};

/// The squares with the most wrong pixels, none of which overlap: the one with the most of all,
/// then the one with the most of those that do not overlap it, and so on. Of equal ones the
/// topmost, then the leftmost. None without a wrong pixel.
/// @param wrong  1 where a pixel is wrong, else 0; row by row
/// @param side   of a picture that is smaller, its shorter side
std::vector<Window> worstWindows(const std::vector<std::uint8_t>& wrong, int width, int height,
                                 int side, std::size_t most);

}  // namespace gnomon::report
