#pragma once

#include <filesystem>
#include <optional>

#include "relief/height_field.h"

namespace gnomon::relief {

/// Reads one channel of an image of any format of `ImageFormat`, told by its content, as
/// image::readGreyPicture does, times `height`: the rules are image::meaningTable's. The first row
/// of the image is the top, v = 1, as renderers take it.
/// @param channel  0-based, without alpha; none: the only one, or three that must be equal
/// @param height   height units of the value 1
/// @throws InputError naming the file as image::readGreyPicture, and for a height that is not
/// finite
///   (naming its pixel); MemoryError where it does not fit
HeightField readHeightImage(const std::filesystem::path& path, std::optional<int> channel,
                            double height, Wrap wrap);

}  // namespace gnomon::relief
