#pragma once

#include <filesystem>

#include "relief/height_field.h"

namespace gnomon::relief {

/// Reads one channel of an image of any format of `ImageFormat`, told by its content. Integers are
/// normalised to [0, 1] (8 and 16 bit), floats are taken as they are; all are then multiplied by
/// `height`. The first row of the image is the top, v = 1, as renderers take it.
/// @param channel  0-based
/// @param height   height units of the value 1
/// @throws InputError naming the file: missing, of another format, unreadable, zero-sized, too
/// short for its pixels, no such channel, or a height that is not finite; MemoryError where it does
/// not fit
HeightField readHeightImage(const std::filesystem::path& path, int channel, double height,
                            Wrap wrap);

}  // namespace gnomon::relief
