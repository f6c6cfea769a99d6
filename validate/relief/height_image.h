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

/// The same relief on a finer map: `factor` times as many texels along x and y, each the height of
/// the bilinear function at its centre. For an odd factor every old texel centre is a new one, so
/// that the old function's kinks stay kinks of the new one, and both are the same function up to
/// float rounding: h'(factor · p) = scale · h(p) everywhere, beyond the border too.
/// @param factor  odd, at least 1
/// @param scale   new height units per old one: `factor` where heights are texels
/// @throws InternalError for an even factor; MemoryError naming `factor` where the finer map cannot
///   fit
HeightField resampledHeights(const HeightField& field, int factor, double scale);

}  // namespace gnomon::relief
