#include "relief/height_image.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "common/error.h"
#include "image/grey_picture.h"

namespace gnomon::relief {
namespace {

void turnUpsideDown(std::vector<float>& texels, std::size_t width) {
  const auto step = static_cast<std::ptrdiff_t>(width);
  auto low = texels.begin();
  auto high = texels.end() - step;
  for (; low < high; low += step, high -= step) std::swap_ranges(low, low + step, high);
}

}  // namespace

HeightField readHeightImage(const std::filesystem::path& path, std::optional<int> channel,
                            double height, Wrap wrap) {
  image::GreyPicture picture =
      image::readGreyPicture(path, {{}, channel}, image::PictureUse::heights);
  const auto width = static_cast<std::size_t>(picture.width);
  for (std::size_t i = 0; i < picture.values.size(); ++i) {
    const float value = picture.values[i];
    picture.values[i] = static_cast<float>(value * height);
    if (std::isfinite(picture.values[i])) continue;
    throw InputError(
        fmt::format("{}: pixel ({}, {}) holds {}, times the height {}: a finite height expected",
                    path.string(), i % width, i / width, value, height));
  }
  turnUpsideDown(picture.values, width);
  return {picture.width, picture.height, std::move(picture.values), wrap};
}

}  // namespace gnomon::relief
