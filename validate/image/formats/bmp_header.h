#pragma once

#include <filesystem>

namespace gnomon::image {

/// Looks through a BMP's header before OpenImageIO does, which takes what a file that ends in its
/// header or its palette does not hold from wherever its memory was. (BITMAPFILEHEADER of 14 bytes,
/// then BITMAPCOREHEADER or BITMAPINFOHEADER and its successors, then the palette.)
/// @throws ImageError where the file ends before its palette does
void requireSoundBmpHeader(const std::filesystem::path& path);

}  // namespace gnomon::image
