#include "report/shrunk_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "common/parallel.h"

namespace gnomon {
namespace {

/// The fourth value is not used: four are what vector units take at once.
using Colour = std::array<float, 4>;

/// What a place of the shrunk side is made of: neighbouring pixels of the longer one, all that have
/// a weight.
struct Taps {
  std::vector<std::size_t> pixels;
  std::vector<float> weights;
};

/// A Lanczos window of three lobes. In single precision and in this order, as OpenImageIO has it.
float lanczos3(float distance) {
  constexpr float lobes = 3;
  constexpr auto pi = std::numbers::pi_v<float>;
  const float x = std::abs(distance);
  if (x > lobes) return 0;
  if (x < 0.0001F) return 1;
  const float sine = std::sin(pi * (x * (1 / lobes)));
  const float sineOfThrice = (3 - 4 * (sine * sine)) * sine;
  return lobes / (x * x * (pi * pi)) * sine * sineOfThrice;
}

/// Of every place of a side that is shrunk. Likewise.
std::vector<Taps> tapsOf(int from, int to) {
  constexpr float width = 6;
  const auto length = static_cast<float>(from);
  const float ratio = static_cast<float>(to) / length;
  const float share = 1.0F / static_cast<float>(to);
  const int radius = static_cast<int>(std::ceil(width / 2 / ratio));
  std::vector<Taps> taps(static_cast<std::size_t>(to));
  for (int place = 0; place < to; ++place) {
    const float middle = (static_cast<float>(place) + 0.5F) * share * length;
    const float pixel = std::floor(middle);
    const float offset = middle - pixel - 0.5F;
    Taps& of = taps[static_cast<std::size_t>(place)];
    float sum = 0;
    for (int i = -radius; i <= radius; ++i) {
      const float weight = lanczos3(ratio * (static_cast<float>(i) - offset));
      if (weight == 0) continue;
      const int nearest = std::clamp(static_cast<int>(pixel) + i, 0, from - 1);
      of.pixels.push_back(static_cast<std::size_t>(nearest));
      of.weights.push_back(weight);
      sum += weight;
    }
    for (float& weight : of.weights) weight /= sum;
  }
  return taps;
}

/// From 0…255 to 0…1 and back, as OpenImageIO does it.
float shareOf(std::uint8_t value) {
  return static_cast<float>(value) * (1.0F / 255.0F);
}

std::uint8_t byteOf(float share) {
  const float scaled = share * 255.0F;
  const float rounded = scaled + (scaled < 0 ? -0.5F : 0.5F);
  return static_cast<std::uint8_t>(std::clamp(rounded, 0.0F, 255.0F));
}

std::vector<Colour> coloursOf(const Image& image) {
  std::vector<Colour> colours(image.rgb.size() / 3);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    colours[i / 3].at(i % 3) = shareOf(image.rgb[i]);
  }
  return colours;
}

/// Adds one row of the longer picture to a row of the shrunk one.
void addRow(const Colour* from, float weight, const std::vector<Taps>& columns,
            std::vector<Colour>& row) {
  for (std::size_t x = 0; x < columns.size(); ++x) {
    const Taps& taps = columns[x];
    Colour sum = row[x];
    for (std::size_t i = 0; i < taps.weights.size(); ++i) {
      const float share = weight * taps.weights[i];
      const Colour& colour = from[taps.pixels[i]];
      for (std::size_t c = 0; c < colour.size(); ++c) sum[c] += share * colour[c];
    }
    row[x] = sum;
  }
}

}  // namespace

Image shrunk(const Image& image, int side) {
  const int longest = std::max(image.width, image.height);
  if (longest <= side) return image;
  const double share = static_cast<double>(side) / longest;
  const auto scaled = [&](int length) {
    return std::max(1, static_cast<int>(std::lround(share * length)));
  };
  Image small{scaled(image.width), scaled(image.height), {}};
  const std::vector<Taps> columns = tapsOf(image.width, small.width);
  const std::vector<Taps> rows = tapsOf(image.height, small.height);
  const std::vector<Colour> colours = coloursOf(image);
  small.rgb.resize(3 * columns.size() * rows.size());
  // Sums run over the taps in their order: rows, then columns. Where each axis is summed by itself,
  // some values round to another byte.
  parallelFor(0, rows.size(), [&](std::size_t y) {
    std::vector<Colour> row(columns.size(), Colour{});
    for (std::size_t j = 0; j < rows[y].weights.size(); ++j) {
      const std::size_t from = rows[y].pixels[j] * static_cast<std::size_t>(image.width);
      addRow(&colours[from], rows[y].weights[j], columns, row);
    }
    for (std::size_t i = 0; i < 3 * row.size(); ++i) {
      small.rgb[3 * y * row.size() + i] = byteOf(row[i / 3].at(i % 3));
    }
  });
  return small;
}

}  // namespace gnomon
