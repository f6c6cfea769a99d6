#include "image/channel_image.h"

#include <fmt/core.h>

#include <memory>
#include <utility>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "image/image_error.h"
#include "image/formats/image_library.h"

namespace gnomon {
namespace {

/// @param name  of the picture, for a message
void requireFilled(const ChannelImage& image, const std::string& name) {
  const auto pixels =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (image.values.empty() || image.values.size() != pixels * image.channels.size()) {
    throw InternalError(fmt::format("{}: {} × {} pixels of {} channels expected, {} values found",
                                    name, image.width, image.height, image.channels.size(),
                                    image.values.size()));
  }
}

ExrDescription describe(const ChannelImage& image, ImageAttributes attributes) {
  return {image.width, image.height, image.channels, NumberType::float32, std::move(attributes)};
}

}  // namespace

void writeExr(const std::filesystem::path& path, const ChannelImage& image,
              const std::vector<std::pair<std::string, std::string>>& attributes) {
  requireFilled(image, path.string());
  const ExrDescription exr = describe(image, ImageAttributes(attributes.begin(), attributes.end()));
  writeAtomically(path, [&](const std::filesystem::path& temporary) {
    try {
      const std::unique_ptr<ImageWriter> out = imageLibrary().createExr(temporary, exr);
      out->writeRows(0, image.height, NumberType::float32, image.values.data());
      out->close();
    } catch (const ImageError& error) {
      throw InputError(fmt::format("{}: cannot be written: {}", path.string(), error.what()));
    }
  });
}

std::string exrBytes(const ChannelImage& image) {
  requireFilled(image, "an EXR");
  try {
    return imageLibrary().exrBytes(describe(image, {}), image.values);
  } catch (const ImageError& error) {
    throw InternalError(fmt::format("an EXR cannot be encoded: {}", error.what()));
  }
}

}  // namespace gnomon
