#pragma once

#include <cstdint>
#include <span>

namespace gnomon::image {

/// The orientation that a block of Exif data states, 1 (upright) to 8; 1 where it states none.
/// (Exif 2.32, tag 274 of the first directory of a TIFF structure.)
int exifOrientation(std::span<const std::uint8_t> exif);

}  // namespace gnomon::image
