#pragma once

#include <limits>
#include <string>
#include <string_view>

#include "image/image.h"

namespace gnomon::image {

/// Pictures as a page embeds them.

/// WebP of a quality at which a shading shows no loss, even enlarged.
constexpr int fineQuality = 95;
/// WebP for a picture that is shown small.
constexpr int smallQuality = 88;
/// Of such a picture: the page shows it at a quarter of its width, on paper at two inches.
constexpr int smallSide = 600;

/// Bytes as the address of a picture: "data:TYPE;base64,…".
std::string dataAddress(std::string_view type, const std::string& bytes);

/// A picture as the bytes of a WebP, with losses. Same image, same bytes. With little effort: the
/// usual one takes 1.4 to 1.9 times as long for shadings 6 % shorter, the utmost yet more for 1 to
/// 3 % of that.
/// @param quality      0 to 100
/// @param longestSide  pixels, at least 1: a longer picture is shrunk to it, each of its new pixels
///   the mean over its area
/// @throws InternalError for a picture without pixels, or with more of them on a side than WebP
///   takes (16,383)
std::string webPicture(const Image& image, int quality,
                       int longestSide = std::numeric_limits<int>::max());

}  // namespace gnomon::image
