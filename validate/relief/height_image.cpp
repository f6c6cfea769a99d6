#include "relief/height_image.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "common/error.h"
#include "common/parallel.h"
#include "common/system/memory.h"
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

namespace {

/// The two old texels between whose centres a new one lies.
struct Between {
  int first, second;  ///< not wrapped
  double share;       ///< of the way to the second, 0 to below 1; 0 on an old centre
};

/// The centre of new texel k lies at (k + 0.5) / factor - 0.5 old texels from the first centre. In
/// whole numbers, so that an old centre is met exactly.
Between between(int k, int factor) {
  const int beyond = k % factor - (factor - 1) / 2;  // the nearest old centre, 1 / factor texels
  const int nearest = k / factor;
  const int first = beyond < 0 ? nearest - 1 : nearest;
  return {first, first + 1, static_cast<double>(beyond < 0 ? beyond + factor : beyond) / factor};
}

}  // namespace

HeightField resampledHeights(const HeightField& field, int factor, double scale) {
  if (factor < 1 || factor % 2 == 0) {
    throw InternalError(fmt::format("a map resampled by {}, an odd factor expected", factor));
  }
  const double columns = static_cast<double>(field.width()) * factor;
  const double rows = static_cast<double>(field.height()) * factor;
  constexpr int copies = 2;  // this one, and one on the GPU
  requireMemory(copies * sizeof(float) * columns * rows,
                fmt::format("{}, a map of {:.0f} × {:.0f} texels", factor, columns, rows),
                "factor");
  const int width = field.width() * factor;
  const int height = field.height() * factor;
  std::vector<float> texels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  parallelFor(0, static_cast<std::size_t>(height), [&](std::size_t row) {
    const Between y = between(static_cast<int>(row), factor);
    for (int column = 0; column < width; ++column) {
      const Between x = between(column, factor);
      const auto along = [&](int j) {
        return std::lerp(static_cast<double>(field.texel(x.first, j)),
                         static_cast<double>(field.texel(x.second, j)), x.share);
      };
      texels[row * static_cast<std::size_t>(width) + static_cast<std::size_t>(column)] =
          static_cast<float>(scale * std::lerp(along(y.first), along(y.second), y.share));
    }
  });
  return {width, height, std::move(texels), field.wrap()};
}

}  // namespace gnomon::relief
