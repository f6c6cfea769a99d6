#pragma once

#include <cstdint>
#include <string>

namespace gnomon {

/// A picture of three 8-bit values a pixel, rows from the top, as the bytes of a PNG. Same picture,
/// same bytes. Written here so that a run that only writes pictures needs no OpenImageIO, and in
/// half of libpng's time: see the source for how.
/// @throws ImageError for a picture without pixels, or where memory does not suffice
std::string pngBytes(int width, int height, const std::uint8_t* rgb);

}  // namespace gnomon
