#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "image/image_module.h"

namespace gnomon::image {

/// Red, green and blue of 8 bits, sRGB.
using Rgb = std::array<std::uint8_t, 3>;

/// A picture of 8-bit sRGB values: three a pixel, row by row, row 0 at the top.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
};

/// A picture of 8-bit greys, row by row, row 0 at the top.
struct ByteImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> values;
};

/// A picture of few colours: the place of each pixel's in a list, row by row, row 0 at the top.
struct PaletteImage {
  int width = 0;
  int height = 0;
  std::vector<Rgb> colours;  ///< at most 256
  std::vector<std::uint8_t> values;
};

/// A picture of 16-bit greys, row by row, row 0 at the top.
struct GreyImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint16_t> values;
};

/// A picture of any number of channels of 32-bit floats.
struct ChannelImage {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;  ///< their names, as "point.X"
  std::vector<float> values;          ///< those of a pixel beside each other, rows from the top
};

/// Writes an EXR, whole or not at all. Same numbers, same bytes.
/// @throws InputError when the file cannot be written
void writeExr(const std::filesystem::path& path, const ExrDescription& description,
              const ImageRows& rows);

/// Likewise, of floats.
/// @param attributes  names and texts for the file's header
/// @throws InternalError also, for values that do not fill the picture
void writeExr(const std::filesystem::path& path, const ChannelImage& image,
              const ImageAttributes& attributes = {});

/// The bytes of that file.
/// @throws InternalError likewise, and where the image cannot be encoded
std::string exrBytes(const ChannelImage& image);

}  // namespace gnomon::image
