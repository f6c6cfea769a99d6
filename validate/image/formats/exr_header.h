#pragma once

#include <filesystem>

namespace gnomon::image {

/// Looks through an EXR's header before OpenEXR does, which takes memory for whatever length an
/// attribute states, and for an index of all tiles that a picture would have: gigabytes for a
/// damaged file of some bytes. (OpenEXR File Layout: attributes are a name and a type that end with
/// a zero, the length of the value, and the value.)
/// @throws ImageError for a header without one of the attributes that all have, for a side over 2²⁰
/// pixels, and where an attribute, a tile, the index of a part's tiles, or the least that its rows
/// need, is longer than the file
void requireSoundExrHeader(const std::filesystem::path& path);

}  // namespace gnomon::image
