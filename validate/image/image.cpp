#include "image/image.h"

#include <fmt/core.h>

#include "common/error.h"
#include "common/files/atomic_file.h"

namespace gnomon::image {

namespace {

ExrDescription describe(const ChannelImage& image, const ImageAttributes& attributes) {
  return {image.width, image.height, image.channels, NumberType::float32, attributes};
}

/// All rows at once.
/// @param name  of the picture, for a message
ImageRows rowsOf(const ChannelImage& image, const std::string& name) {
  const auto pixels =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (image.values.empty() || image.values.size() != pixels * image.channels.size()) {
    throw InternalError(fmt::format("{}: {} × {} pixels of {} channels expected, {} values found",
                                    name, image.width, image.height, image.channels.size(),
                                    image.values.size()));
  }
  return {NumberType::float32, image.height, [&](int, int) { return image.values.data(); }};
}

}  // namespace

void writeExr(const std::filesystem::path& path, const ExrDescription& description,
              const ImageRows& rows) {
  writeAtomically(path, [&](int file) {
    try {
      imageModule().writeExr(file, description, rows);
    } catch (const ImageError& error) {
      throw InputError(fmt::format("{}: cannot be written: {}", path.string(), error.what()));
    }
  });
}

void writeExr(const std::filesystem::path& path, const ChannelImage& image,
              const ImageAttributes& attributes) {
  const ImageRows rows = rowsOf(image, path.string());
  writeExr(path, describe(image, attributes), rows);
}

std::string exrBytes(const ChannelImage& image) {
  try {
    return imageModule().writeExr({}, describe(image, {}), rowsOf(image, "an EXR"));
  } catch (const ImageError& error) {
    throw InternalError(fmt::format("an EXR cannot be encoded: {}", error.what()));
  }
}

}  // namespace gnomon::image
