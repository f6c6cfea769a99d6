#include "relief/height_image.h"

#include <OpenImageIO/imageio.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "common/error.h"
#include "common/memory.h"
#include "common/one_line.h"
#include "relief/exr_limit.h"

namespace gnomon {
namespace {
namespace fs = std::filesystem;

std::unique_ptr<OIIO::ImageInput> openImage(const fs::path& path) {
  std::error_code failure;
  if (!fs::is_regular_file(path, failure)) {
    throw InputError(fmt::format("{}: no such file, an image was expected", path.string()));
  }
  // Heights are data: a colour channel must not come multiplied by the image's alpha.
  OIIO::ImageSpec wishes;
  wishes.attribute("oiio:UnassociatedAlpha", 1);
  limitExrSize();
  auto image = OIIO::ImageInput::open(path.string(), &wishes);
  if (!image) {
    throw InputError(fmt::format("{}: not an image that can be read: {}", path.string(),
                                 oneLine(OIIO::geterror())));
  }
  return image;
}

void checkSpec(const fs::path& path, const OIIO::ImageSpec& spec, int channel) {
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.deep) {
    throw InputError(fmt::format("{}: {} x {} x {} {}pixels, a flat image expected", path.string(),
                                 spec.width, spec.height, spec.depth, spec.deep ? "deep " : ""));
  }
  if (channel < 0 || channel >= spec.nchannels) {
    throw InputError(fmt::format("{}: no channel {}, the image has 0 to {}", path.string(), channel,
                                 spec.nchannels - 1));
  }
  // The library may hold a converted copy of the image beside the channel and the map.
  const double pixels = static_cast<double>(spec.width) * spec.height;
  requireMemory(
      pixels * (2 * sizeof(float) + static_cast<double>(spec.pixel_bytes(true))),
      fmt::format("{}: an image of {} x {} pixels", path.string(), spec.width, spec.height));
}

/// The image's rows from the top.
std::vector<float> readChannel(const fs::path& path, OIIO::ImageInput& image,
                               const OIIO::ImageSpec& spec, int channel) {
  std::vector<float> pixels(static_cast<std::size_t>(spec.width) *
                            static_cast<std::size_t>(spec.height));
  // The TIFF reader answers true for a file that is cut off, but keeps its error.
  if (!image.read_image(0, 0, channel, channel + 1, OIIO::TypeDesc::FLOAT, pixels.data()) ||
      image.has_error()) {
    throw InputError(
        fmt::format("{}: its pixels cannot be read: {}", path.string(), oneLine(image.geterror())));
  }
  return pixels;
}

}  // namespace

HeightField readHeightImage(const fs::path& path, int channel, double height, Wrap wrap) {
  const auto image = openImage(path);
  const OIIO::ImageSpec spec = image->spec();
  checkSpec(path, spec, channel);
  const std::vector<float> pixels = readChannel(path, *image, spec, channel);

  std::vector<float> texels(pixels.size());
  const auto width = static_cast<std::size_t>(spec.width);
  const auto rows = static_cast<std::size_t>(spec.height);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t x = 0; x < width; ++x) {
      const auto value = static_cast<float>(pixels[row * width + x] * height);
      if (!std::isfinite(value)) {
        throw InputError(fmt::format(
            "{}: pixel ({}, {}) holds {}, times the height {}: a finite height expected",
            path.string(), x, row, pixels[row * width + x], height));
      }
      texels[(rows - 1 - row) * width + x] = value;
    }
  }
  return {spec.width, spec.height, std::move(texels), wrap};
}

}  // namespace gnomon
