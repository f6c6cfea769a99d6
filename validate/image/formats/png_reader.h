#pragma once

#include <filesystem>
#include <memory>

#include "image/formats/image_reader.h"

namespace gnomon {

/// Opens a PNG by libpng itself. OpenImageIO's reader lets libpng print its errors to standard
/// error, and leaves functions by longjmp past their destructors. Palettes become colours,
/// transparent colours alpha, numbers of less than 8 bits 8 bits.
/// @throws ImageError
std::unique_ptr<ImageReader> openPng(const std::filesystem::path& path);

}  // namespace gnomon
