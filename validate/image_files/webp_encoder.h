#pragma once

#include <cstdint>
#include <string>

namespace gnomon {

/// A picture of three 8-bit values a pixel, rows from the top, as the bytes of a WebP, with losses.
/// Same picture, same bytes. OpenImageIO asks its encoder for the utmost effort, which takes one
/// and a half times to twice as long for pictures 1 to 3 % shorter; this is the encoder itself at
/// its usual effort.
/// @param quality  0 to 100
/// @throws ImageError
std::string webPBytes(int width, int height, const std::uint8_t* rgb, int quality);

}  // namespace gnomon
