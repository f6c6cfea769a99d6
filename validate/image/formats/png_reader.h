#pragma once

#include <filesystem>
#include <memory>

#include "image/image_reader.h"

namespace gnomon::image {

/// Opens a PNG by libspng, which answers with a status where libpng leaves functions by longjmp.
/// (OpenImageIO's reader lets libpng do so past its destructors, and print its errors to standard
/// error.) Palettes become colours, transparent colours alpha, numbers of less than 8 bits 8 bits.
/// @throws ImageError
std::unique_ptr<ImageReader> openPng(const std::filesystem::path& path);

}  // namespace gnomon::image
