#pragma once

#include <filesystem>
#include <memory>

#include "image/image_module.h"

namespace gnomon::image {

/// Opens a TIFF by libtiff. (OpenImageIO's reader leaves rows of 64-bit floats unwritten, turns
/// white as 0 round in 8 bits alone, alpha with it, and takes strips that hold less than their
/// rows.) Palettes become colours. Read are integers of 1 to 16 and of 32 bits, floats of 16, 32
/// and 64 bits, in strips and tiles, of both orders of bytes, in every packing that libtiff knows.
/// White as 0 is turned round in integers of up to 16 bits: in all others it has no number.
/// "No value" is GDAL's tag 42113; without it, -32,768 in integers of 16 bits.
/// @throws ImageError
std::unique_ptr<ImageReader> openTiff(const std::filesystem::path& path);

}  // namespace gnomon::image
