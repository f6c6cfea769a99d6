#pragma once

#include <string>

#include "image/channel_image.h"

namespace gnomon::exporting {

/// A picture as the bytes of a NumPy file (format 1.0): 32-bit little-endian floats of shape
/// (height, width, channels), row 0 at the top. Same numbers, same bytes.
std::string npyBytes(const image::ChannelImage& image);

}  // namespace gnomon::exporting
