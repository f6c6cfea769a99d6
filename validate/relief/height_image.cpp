#include "relief/height_image.h"

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
#include "image_files/image_error.h"
#include "image_files/image_library.h"

namespace gnomon {
namespace {
namespace fs = std::filesystem;

std::unique_ptr<ImageReader> openImage(const fs::path& path) {
  std::error_code failure;
  if (!fs::is_regular_file(path, failure)) {
    throw InputError(fmt::format("{}: no such file, an image was expected", path.string()));
  }
  try {
    return imageLibrary().open(path);
  } catch (const ImageError& error) {
    throw InputError(
        fmt::format("{}: not an image that can be read: {}", path.string(), oneLine(error.what())));
  }
}

void checkFacts(const fs::path& path, const ImageFacts& facts, int channel) {
  const auto [width, height] = std::pair(facts.data.width, facts.data.height);
  if (width < 1 || height < 1 || facts.depth > 1 || facts.isDeep) {
    throw InputError(fmt::format("{}: {} x {} x {} {}pixels, a flat image expected", path.string(),
                                 width, height, facts.depth, facts.isDeep ? "deep " : ""));
  }
  if (channel < 0 || channel >= facts.channelCount()) {
    throw InputError(fmt::format("{}: no channel {}, the image has 0 to {}", path.string(), channel,
                                 facts.channelCount() - 1));
  }
  // The library may hold a converted copy of the image beside the channel and the map.
  const double pixels = static_cast<double>(width) * height;
  requireMemory(pixels * (2 * sizeof(float) + static_cast<double>(facts.bytesAPixel)),
                fmt::format("{}: an image of {} x {} pixels", path.string(), width, height));
}

/// The image's rows from the top.
std::vector<float> readChannel(const fs::path& path, ImageReader& image, const ImageFacts& facts,
                               int channel) {
  std::vector<float> pixels(static_cast<std::size_t>(facts.data.width) *
                            static_cast<std::size_t>(facts.data.height));
  try {
    image.read(channel, channel + 1, NumberType::float32, pixels.data());
  } catch (const ImageError& error) {
    throw InputError(
        fmt::format("{}: its pixels cannot be read: {}", path.string(), oneLine(error.what())));
  }
  return pixels;
}

}  // namespace

HeightField readHeightImage(const fs::path& path, int channel, double height, Wrap wrap) {
  const auto image = openImage(path);
  const ImageFacts facts = image->facts();
  checkFacts(path, facts, channel);
  const std::vector<float> pixels = readChannel(path, *image, facts, channel);

  std::vector<float> texels(pixels.size());
  const auto width = static_cast<std::size_t>(facts.data.width);
  const auto rows = static_cast<std::size_t>(facts.data.height);
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
  return {facts.data.width, facts.data.height, std::move(texels), wrap};
}

}  // namespace gnomon
