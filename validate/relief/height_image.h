#pragma once

#include <filesystem>

#include "relief/height_field.h"

namespace gnomon {

/// Reads one channel of an image of any format that OpenImageIO knows. Integers are normalised to
/// [0, 1] (8 and 16 bit), floats are taken as they are; all are then multiplied by `height`.
/// The first row of the image is the top, v = 1, as renderers take it.
/// @param channel  0-based
/// @param height   height units of the value 1
/// @throws InputError naming the file: missing, unreadable, zero-sized, no such channel, or a
/// height that is not finite
HeightField readHeightImage(const std::filesystem::path& path, int channel, double height,
                            Wrap wrap);

}  // namespace gnomon
