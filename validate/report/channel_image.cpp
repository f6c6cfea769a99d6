#include "report/channel_image.h"

#include <fmt/core.h>

#include <memory>

#include "common/atomic_file.h"
#include "common/error.h"
#include "image_files/image_error.h"
#include "image_files/image_library.h"

namespace gnomon {
void writeExr(const std::filesystem::path& path, const ChannelImage& image,
              const std::vector<std::pair<std::string, std::string>>& attributes) {
  const auto pixels =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (image.values.empty() || image.values.size() != pixels * image.channels.size()) {
    throw InternalError(fmt::format("{}: {} × {} pixels of {} channels expected, {} values found",
                                    path.string(), image.width, image.height, image.channels.size(),
                                    image.values.size()));
  }
  const ExrDescription exr{image.width, image.height, image.channels, NumberType::float32,
                           ImageAttributes(attributes.begin(), attributes.end())};
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

}  // namespace gnomon
