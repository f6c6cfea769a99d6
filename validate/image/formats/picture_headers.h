#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

namespace gnomon::image {

/// Looks through a BMP's header before OpenImageIO does, which takes what a file that ends in its
/// header or its palette does not hold from wherever its memory was. (BITMAPFILEHEADER of 14 bytes,
/// then BITMAPCOREHEADER or BITMAPINFOHEADER and its successors, then the palette.)
/// @throws ImageError where the file ends before its palette does
void requireSoundBmpHeader(const std::filesystem::path& file);

/// What the frame header of a JPEG states (ITU-T T.81, B.2.2).
struct JpegFrame {
  int width = 0;
  int height = 0;
  int components = 0;
};

/// The first frame header of a file; none where it has none. Looked up before libjpeg is asked,
/// which takes memory for all coefficients of a progressive picture before it decodes any.
std::optional<JpegFrame> jpegFrame(const std::filesystem::path& file);

/// The orientation that a block of Exif data states, 1 (upright) to 8; 1 where it states none.
/// (Exif 2.32, tag 274 of the first directory of a TIFF structure.)
int exifOrientation(std::span<const std::uint8_t> exif);

/// Looks through an EXR's header before OpenEXR does, which takes memory for whatever length an
/// attribute states, and for an index of all tiles that a picture would have: gigabytes for a
/// damaged file of some bytes. (OpenEXR File Layout: attributes are a name and a type that end with
/// a zero, the length of the value, and the value.)
/// @throws ImageError for a header without one of the attributes that all have, for a side over 2²⁰
/// pixels, and where an attribute, a tile, the index of a part's tiles, or the least that its rows
/// need, is longer than the file
void requireSoundExrHeader(const std::filesystem::path& file);

}  // namespace gnomon::image
