#include "relief/height_image.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "image/image_file.h"

namespace gnomon::relief {
namespace {

/// The height of a pixel.
float heightOf(const image::ImageFile& image, float value, double height, std::size_t column,
               int row) {
  const auto found = static_cast<float>(value * height);
  if (std::isfinite(found)) return found;
  image.refuse(fmt::format("pixel ({}, {}) holds {}, times the height {}: a finite height expected",
                           column, row, value, height));
}

void turnUpsideDown(std::vector<float>& texels, std::size_t width) {
  const auto step = static_cast<std::ptrdiff_t>(width);
  auto low = texels.begin();
  auto high = texels.end() - step;
  for (; low < high; low += step, high -= step) std::swap_ranges(low, low + step, high);
}

}  // namespace

HeightField readHeightImage(const std::filesystem::path& path, int channel, double height,
                            Wrap wrap) {
  image::ImageFile image(path);
  const image::ImageFacts facts = image.facts();
  image.requireReadable(sizeof(float));
  if (channel < 0 || channel >= facts.channelCount()) {
    image.refuse(
        fmt::format("no channel {}, the image has 0 to {}", channel, facts.channelCount() - 1));
  }
  const auto width = static_cast<std::size_t>(facts.data.width);
  std::vector<float> texels;
  // What a damaged file does not hold is never touched.
  texels.reserve(width * static_cast<std::size_t>(facts.data.height));
  const auto append = [&](const float* values, int top, int rows) {
    for (int row = top; row < top + rows; ++row) {
      for (std::size_t x = 0; x < width; ++x) {
        texels.push_back(heightOf(image, *values++, height, x, row));
      }
    }
  };
  image.readBands<float>(channel, channel + 1, image::NumberType::float32, append);
  turnUpsideDown(texels, width);
  return {facts.data.width, facts.data.height, std::move(texels), wrap};
}

}  // namespace gnomon::relief
