#include "report/shrunk_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "common/parallel.h"
#include "common/raw_vector.h"

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

void add(float weight, const Colour& colour, Colour& sum) {
  for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += weight * colour[c];
}

/// One row of the longer picture, its columns summed.
void sumColumns(const std::uint8_t* rgb, std::vector<Colour>& colours,
                const std::vector<Taps>& columns, Colour* row) {
  for (std::size_t i = 0; i < colours.size(); ++i, rgb += 3) {
    colours[i] = {shareOf(rgb[0]), shareOf(rgb[1]), shareOf(rgb[2]), 0};
  }
  for (const Taps& taps : columns) {
    Colour sum{};
    for (std::size_t i = 0; i < taps.weights.size(); ++i) {
      add(taps.weights[i], colours[taps.pixels[i]], sum);
    }
    *row++ = sum;
  }
}

/// One row of the shrunk picture, of rows whose columns are summed.
std::vector<Colour> sumRows(const RawVector<Colour>& narrow, std::size_t width, const Taps& taps) {
  std::vector<Colour> sums(width);
  for (std::size_t i = 0; i < taps.weights.size(); ++i) {
    const Colour* from = &narrow[taps.pixels[i] * width];
    for (std::size_t x = 0; x < width; ++x) add(taps.weights[i], from[x], sums[x]);
  }
  return sums;
}

/// One value of one place as OpenImageIO sums it: tap by tap, rows, then columns.
float orderedSum(const Image& image, const Taps& row, const Taps& column, std::size_t channel) {
  float sum = 0;
  for (std::size_t j = 0; j < row.weights.size(); ++j) {
    const std::size_t from = row.pixels[j] * static_cast<std::size_t>(image.width);
    for (std::size_t i = 0; i < column.weights.size(); ++i) {
      const float share = row.weights[j] * column.weights[i];
      sum += share * shareOf(image.rgb[3 * (from + column.pixels[i]) + channel]);
    }
  }
  return sum;
}

/// Whether this sum and one in another order round to the same byte. Terms sum up to less than 2,
/// so that each sum is off by less than an epsilon for every term.
bool isSameInAnyOrder(float sum, std::size_t terms) {
  const float room = 2 * std::numeric_limits<float>::epsilon() * static_cast<float>(terms);
  return byteOf(sum - room) == byteOf(sum + room);
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
  small.rgb.resize(3 * columns.size() * rows.size());
  // Each axis is summed by itself, in a tenth of the terms; what that might round to another byte
  // is summed again.
  const auto width = static_cast<std::size_t>(image.width);
  RawVector<Colour> narrow(columns.size() * static_cast<std::size_t>(image.height));
  constexpr std::size_t rowsAtOnce = 16;
  const std::size_t strips = (static_cast<std::size_t>(image.height) + rowsAtOnce - 1) / rowsAtOnce;
  parallelFor(0, strips, [&](std::size_t strip) {
    std::vector<Colour> colours(width);
    const std::size_t first = strip * rowsAtOnce;
    const std::size_t end = std::min(first + rowsAtOnce, static_cast<std::size_t>(image.height));
    for (std::size_t y = first; y < end; ++y) {
      sumColumns(&image.rgb[3 * width * y], colours, columns, &narrow[columns.size() * y]);
    }
  });
  parallelFor(0, rows.size(), [&](std::size_t y) {
    const std::vector<Colour> sums = sumRows(narrow, columns.size(), rows[y]);
    for (std::size_t x = 0; x < columns.size(); ++x) {
      const std::size_t terms = rows[y].weights.size() * columns[x].weights.size();
      for (std::size_t c = 0; c < 3; ++c) {
        const float sum = isSameInAnyOrder(sums[x][c], terms)
                              ? sums[x][c]
                              : orderedSum(image, rows[y], columns[x], c);
        small.rgb[3 * (y * columns.size() + x) + c] = byteOf(sum);
      }
    }
  });
  return small;
}

}  // namespace gnomon
