#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace gnomon {

/// A picture of any number of channels of 32-bit floats.
struct ChannelImage {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;  ///< their names, as "point.X"
  std::vector<float> values;          ///< those of a pixel beside each other, rows from the top
};

/// Writes an EXR of floats, whole or not at all. Same image, same bytes.
/// @param attributes  names and texts for the file's header
/// @throws InputError when the file cannot be written, InternalError for values that do not fill
///   the picture
void writeExr(const std::filesystem::path& path, const ChannelImage& image,
              const std::vector<std::pair<std::string, std::string>>& attributes = {});

/// The bytes of that file.
/// @throws InternalError likewise, and where the image cannot be encoded
std::string exrBytes(const ChannelImage& image);

}  // namespace gnomon
