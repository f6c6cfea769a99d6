#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "image/image_format.h"
#include "image/image_module.h"

namespace gnomon::image {

/// The most bytes of pixels that a byte of a file can hold, by format and coding: infinite where a
/// coding has no bound. A header that promises more is damaged, and nothing is decoded for it.
/// With twice the room that the codings need:
///   deflate 1032 (zlib's technical notes), also inside EXR (ZIP, ZIPS, PXR24) and TIFF
///   LZW     1365: strings that grow to 4096 - 258 bytes, in codes of 9 to 12 bits
///   JPEG    1024: at least one bit for each block of 64 numbers and scan
///   PIZ     some 400: runs of up to 255 numbers in two codes
///   runs    128, in HDR, TGA, TIFF and EXR
/// @param coding  as OpenImageIO names it in `compression`; empty where a format has but one
double mostBytesAByteHolds(ImageFormat format, const std::string& coding);

/// Opens a PNG by libspng, which answers with a status where libpng leaves functions by longjmp.
/// (OpenImageIO's reader lets libpng do so past its destructors, and print its errors to standard
/// error.) Palettes become colours, transparent colours alpha, numbers of less than 8 bits 8 bits.
/// @throws ImageError
std::unique_ptr<ImageReader> openPng(const std::filesystem::path& file);

}  // namespace gnomon::image
