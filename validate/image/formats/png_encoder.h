#pragma once

#include <cstdint>
#include <string>

namespace gnomon {

/// A picture of three 8-bit values a pixel, rows from the top, as the bytes of a PNG. Same picture,
/// same bytes. By libpng itself, so that a run that only writes pictures need not load OpenImageIO.
/// @throws ImageError for a picture without pixels or more than 10⁶ a side, or where memory ends
std::string pngBytes(int width, int height, const std::uint8_t* rgb);

}  // namespace gnomon
