#include "report/channel_image.h"

#include <OpenImageIO/imageio.h>
#include <fmt/core.h>

#include <memory>

#include "common/atomic_file.h"
#include "common/error.h"

namespace gnomon {
namespace {

OIIO::ImageSpec specOf(const ChannelImage& image,
                       const std::vector<std::pair<std::string, std::string>>& attributes) {
  OIIO::ImageSpec spec(image.width, image.height, static_cast<int>(image.channels.size()),
                       OIIO::TypeDesc::FLOAT);
  spec.channelnames = image.channels;
  spec.alpha_channel = spec.z_channel = -1;
  spec.attribute("compression", "zip");
  // The writer would put in the time: the same picture is the same bytes.
  spec.attribute("DateTime", "1970:01:01 00:00:00");
  for (const auto& [name, text] : attributes) spec.attribute(name, text);
  return spec;
}

}  // namespace

void writeExr(const std::filesystem::path& path, const ChannelImage& image,
              const std::vector<std::pair<std::string, std::string>>& attributes) {
  const auto pixels =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (image.values.empty() || image.values.size() != pixels * image.channels.size()) {
    throw InternalError(fmt::format("{}: {} × {} pixels of {} channels expected, {} values found",
                                    path.string(), image.width, image.height, image.channels.size(),
                                    image.values.size()));
  }
  writeAtomically(path, [&](const std::filesystem::path& temporary) {
    const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create("openexr");
    if (!out) throw InternalError("OpenImageIO: no writer for EXR: " + OIIO::geterror());
    if (!out->open(temporary.string(), specOf(image, attributes)) ||
        !out->write_image(OIIO::TypeDesc::FLOAT, image.values.data()) || !out->close()) {
      throw InputError(fmt::format("{}: cannot be written: {}", path.string(), out->geterror()));
    }
  });
}

}  // namespace gnomon
