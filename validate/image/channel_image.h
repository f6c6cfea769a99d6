#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "image/image_module.h"

namespace gnomon::image {

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
