#include "relief/padded_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/parallel.h"

namespace gnomon {
namespace {

constexpr int blockShift = PaddedMap::blockShift;

void fillHeights(const HeightField& field, double middle, PaddedMap& map) {
  std::vector<std::size_t> columns(static_cast<std::size_t>(map.stride));
  for (std::ptrdiff_t x = 0; x < map.stride; ++x) {
    columns[static_cast<std::size_t>(x)] = static_cast<std::size_t>(
        wrappedIndex(static_cast<int>(x - map.margin), field.width(), field.wrap()));
  }
  parallelFor(0, static_cast<std::size_t>(map.rows), [&](std::size_t y) {
    const int j = wrappedIndex(static_cast<int>(static_cast<std::ptrdiff_t>(y) - map.margin),
                               field.height(), field.wrap());
    const float* row = field.texels().data() +
                       static_cast<std::size_t>(j) * static_cast<std::size_t>(field.width());
    float* out = map.heights.data() + y * columns.size();
    for (std::size_t x = 0; x < columns.size(); ++x) {
      out[x] = static_cast<float>(row[columns[x]] - middle);
    }
  });
}

void fillTwists(PaddedMap& map) {
  const auto stride = static_cast<std::size_t>(map.stride);
  parallelFor(0, static_cast<std::size_t>(map.rows - 1), [&](std::size_t y) {
    const float* lower = map.heights.data() + y * stride;
    const float* upper = lower + stride;
    float* out = map.twists.data() + y * stride;
    for (std::size_t x = 0; x + 1 < stride; ++x) {
      out[x] = (lower[x] - lower[x + 1]) - (upper[x] - upper[x + 1]);
    }
  });
}

void fillBlockMaxima(PaddedMap& map) {
  const auto stride = static_cast<std::size_t>(map.stride);
  const auto blockStride = static_cast<std::size_t>(map.blockStride);
  const auto rows = static_cast<std::size_t>(map.rows);
  parallelFor(0, map.blockMaxima.size() / blockStride, [&](std::size_t by) {
    float* out = map.blockMaxima.data() + by * blockStride;
    for (std::size_t y = by << blockShift; y < std::min(rows, (by + 1) << blockShift); ++y) {
      const float* in = map.heights.data() + y * stride;
      for (std::size_t x = 0; x < stride; ++x) {
        out[x >> blockShift] = std::max(out[x >> blockShift], in[x]);
      }
    }
  });
}

}  // namespace

PaddedMap padMap(const HeightField& field, double radius, int overhang) {
  const double highest = field.maximum();
  const double lowest = field.minimum();
  const double middle = 0.5 * (lowest + highest);
  PaddedMap map;
  map.margin = static_cast<std::ptrdiff_t>(std::ceil(radius)) + 2;
  map.stride = field.width() + 2 * map.margin + overhang;
  map.rows = field.height() + 2 * map.margin + 1;
  map.blockStride = (map.stride >> blockShift) + 1;
  map.maximum = static_cast<float>(highest - middle);
  map.tolerance = 0x1p-20 * static_cast<float>(highest - lowest);
  const auto texels = static_cast<std::size_t>(map.stride * map.rows);
  const auto blocks = static_cast<std::size_t>(map.blockStride * ((map.rows >> blockShift) + 1));
  map.heights.resize(texels);
  map.twists.resize(texels);
  map.blockMaxima.assign(blocks, -std::numeric_limits<float>::infinity());
  fillHeights(field, middle, map);
  fillTwists(map);
  fillBlockMaxima(map);
  return map;
}

double paddedMapBytes(const HeightField& field, double radius, int overhang) {
  const double margins = 2 * (std::ceil(radius) + 2);
  const double texels = (field.width() + margins + overhang) * (field.height() + margins + 1);
  constexpr double withBlocks = 1.01;
  return 2 * sizeof(float) * withBlocks * texels;
}

}  // namespace gnomon
