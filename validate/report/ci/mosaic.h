#pragma once

#include <filesystem>
#include <string>

namespace gnomon::report {

/// A signed difference (image::DifferenceColours) as lines of coloured squares, for a page that
/// shows no pictures of its own: 🟧 false shadow, 🟦 false light, ⬜ both lit, ⬛ both
/// shadowed, 🟫 no samples. A square stands for a block of pixels of which it is the most
/// frequent kind; but where an eighth of the block's samples is wrong, the more frequent error.
/// @param columns  squares a line, at least 1; no more than the picture has pixels
/// @throws InputError naming the file for a picture with any other colour, and as readGreyPicture
std::string mosaicOf(const std::filesystem::path& difference, int columns);

}  // namespace gnomon::report
