#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::compare {

/// A square of a picture, its corner at the left top.
struct Window {
  int left = 0, top = 0;
  int side = 0;      ///< pixels
  double error = 0;  ///< sum over its pixels
};

/// The squares with the largest error, none of which overlap: the one with the most of all, then
/// the one with the most of those that do not overlap it, and so on. Of equal ones the topmost,
/// then the leftmost. None without an error.
/// @param errors  of each pixel, row by row: 1 or 0 for wrong or right; under a light with a disc
///                |ΔV|, at most 1
/// @param side    of a picture that is smaller, its shorter side
std::vector<Window> worstWindows(std::span<const float> errors, int width, int height, int side,
                                 std::size_t most);
std::vector<Window> worstWindows(std::span<const std::uint8_t> errors, int width, int height,
                                 int side, std::size_t most);

}  // namespace gnomon::compare
