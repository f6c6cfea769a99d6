#include "relief/height_field.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "common/error.h"
#include "common/parallel.h"
#include "common/system/memory.h"
#include "image/grey_picture.h"

namespace gnomon::relief {

int wrappedIndex(int i, int size, Wrap wrap) {
  if (wrap == Wrap::clamp) return std::clamp(i, 0, size - 1);
  if (i >= 0 && i < size) return i;  // the common case, without a division
  const int remainder = i % size;
  return remainder < 0 ? remainder + size : remainder;
}

Neighbours neighbours(double coordinate, int size, Wrap wrap) {
  // Reduced in floating point first: the coordinate may exceed what an int holds.
  double c = coordinate - 0.5;
  if (wrap == Wrap::repeat) {
    // May be negative: wrappedIndex sees to that.
    if (std::abs(c) >= size) c = std::fmod(c, size);
  } else {
    c = std::clamp(c, 0.0, static_cast<double>(size - 1));
  }
  const double below = std::floor(c);
  const int first = static_cast<int>(below);
  return {wrappedIndex(first, size, wrap), wrappedIndex(first + 1, size, wrap), c - below};
}

namespace {

void checkSize(int width, int height, std::size_t texelCount) {
  if (width < 1 || height < 1) {
    throw InputError(
        fmt::format("height map: {} x {} texels, at least 1 x 1 expected", width, height));
  }
  const std::size_t expected = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (texelCount != expected) {
    throw InputError(fmt::format("height map: {} heights for {} x {} texels, {} expected",
                                 texelCount, width, height, expected));
  }
}

void checkFinite(int width, const std::vector<float>& texels) {
  const auto bad =
      std::find_if(texels.begin(), texels.end(), [](float h) { return !std::isfinite(h); });
  if (bad == texels.end()) return;
  const auto index = bad - texels.begin();
  throw InputError(fmt::format("height map: texel ({}, {}) is {}, a finite height expected",
                               index % width, index / width, *bad));
}

double mix(double a, double b, double share) {
  return a + (b - a) * share;
}

/// As `knownLength`, along one axis.
double knownAlong(double place, double direction, int size) {
  if (direction == 0) return std::numeric_limits<double>::infinity();
  const double ahead = direction > 0 ? size - place : place;
  return std::max(ahead, 0.0) / std::abs(direction);
}

}  // namespace

HeightField inverted(const HeightField& field, double height) {
  std::vector<float> texels = field.texels();
  for (float& texel : texels) texel = static_cast<float>(height - texel);
  return {field.width(), field.height(), std::move(texels), field.wrap(), field.border()};
}

HeightField::HeightField(int width, int height, std::vector<float> texels, Wrap wrap, Border border)
    : width_(width),
      height_(height),
      texels_(std::make_shared<const std::vector<float>>(std::move(texels))),
      first_(texels_->data()),
      wrap_(wrap),
      border_(border),
      minimum_(0),
      maximum_(0) {
  checkSize(width_, height_, texels_->size());
  checkFinite(width_, *texels_);
  const auto [least, greatest] = std::minmax_element(texels_->begin(), texels_->end());
  minimum_ = *least;
  maximum_ = *greatest;
}

float HeightField::texel(int i, int j) const {
  const auto column = static_cast<std::size_t>(wrappedIndex(i, width_, wrap_));
  const auto row = static_cast<std::size_t>(wrappedIndex(j, height_, wrap_));
  return first_[row * static_cast<std::size_t>(width_) + column];
}

double HeightField::at(Vec2 texelPosition) const {
  if (!std::isfinite(texelPosition.x) || !std::isfinite(texelPosition.y)) {
    throw InternalError(fmt::format("height asked for at texel position ({}, {})", texelPosition.x,
                                    texelPosition.y));
  }
  const Neighbours x = neighbours(texelPosition.x, width_, wrap_);
  const Neighbours y = neighbours(texelPosition.y, height_, wrap_);
  const auto stored = [this](int i, int j) -> double {
    return first_[static_cast<std::size_t>(j) * static_cast<std::size_t>(width_) +
                  static_cast<std::size_t>(i)];
  };
  return mix(mix(stored(x.first, y.first), stored(x.second, y.first), x.share),
             mix(stored(x.first, y.second), stored(x.second, y.second), x.share), y.share);
}

double HeightField::knownLength(Vec2 texelPosition, Vec2 direction) const {
  double length = std::numeric_limits<double>::infinity();
  if (border_.x) length = std::min(length, knownAlong(texelPosition.x, direction.x, width_));
  if (border_.y) length = std::min(length, knownAlong(texelPosition.y, direction.y, height_));
  return length;
}

HeightField HeightField::withBorder(Border border) const& {
  return HeightField(*this).withBorder(border);
}

HeightField HeightField::withBorder(Border border) && {
  border_ = border;
  return std::move(*this);
}

HeightField readHeightImage(const std::filesystem::path& file, std::optional<int> channel,
                            double height, Wrap wrap) {
  image::GreyPicture picture =
      image::readGreyPicture(file, {{}, channel}, image::PictureUse::heights);
  const auto width = static_cast<std::size_t>(picture.width);
  for (std::size_t i = 0; i < picture.values.size(); ++i) {
    const float value = picture.values[i];
    picture.values[i] = static_cast<float>(value * height);
    if (std::isfinite(picture.values[i])) continue;
    throw InputError(
        fmt::format("{}: pixel ({}, {}) holds {}, times the height {}: a finite height expected",
                    file.string(), i % width, i / width, value, height));
  }
  image::flipRows(picture.values, picture.width);
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
