#include "relief/padded_map.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "common/parallel.h"

namespace gnomon {
namespace {

/// Texels that a row is longer than it need be, so that whole vectors can be read at its end.
constexpr std::ptrdiff_t overhang = 64;

/// Also of the four nodes of a cell, whose lower left one was folded.
double marginOf(int side, double radius, Wrap wrap) {
  const double reach = std::ceil(radius) + 2;
  const int half = side / 2;
  return wrap == Wrap::repeat ? std::min(reach, half + 2.0) : reach;
}

/// The representative of an offset, modulo a side, from -side/2 on.
int foldedOffset(int offset, int side) {
  const int half = side / 2;
  return wrappedIndex(offset + half, side, Wrap::repeat) - half;
}

void fillHeights(const HeightField& field, double middle, PaddedMap& map) {
  std::vector<std::size_t> columns(static_cast<std::size_t>(map.stride));
  for (std::ptrdiff_t x = 0; x < map.stride; ++x) {
    columns[static_cast<std::size_t>(x)] = static_cast<std::size_t>(
        wrappedIndex(static_cast<int>(x - map.marginX), field.width(), field.wrap()));
  }
  parallelFor(0, static_cast<std::size_t>(map.rows), [&](std::size_t y) {
    const int j = wrappedIndex(static_cast<int>(static_cast<std::ptrdiff_t>(y) - map.marginY),
                               field.height(), field.wrap());
    const float* row = field.texels().data() +
                       static_cast<std::size_t>(j) * static_cast<std::size_t>(field.width());
    float* out = map.heights.data() + y * columns.size();
    for (std::size_t x = 0; x < columns.size(); ++x) {
      out[x] = static_cast<float>(row[columns[x]] - middle);
    }
  });
}

using Range = std::pair<float, float>;

/// @returns the lowest and the highest twist of the row
Range fillTwistRow(const float* lower, const float* upper, std::size_t count, float* out) {
  float least = 0;
  float most = 0;
  for (std::size_t x = 0; x < count; ++x) {
    out[x] = (lower[x] - lower[x + 1]) - (upper[x] - upper[x + 1]);
    least = std::min(least, out[x]);
    most = std::max(most, out[x]);
  }
  out[count] = 0;
  return {least, most};
}

void fillTwists(PaddedMap& map) {
  const auto stride = static_cast<std::size_t>(map.stride);
  const auto last = static_cast<std::size_t>(map.rows - 1);
  std::vector<Range> ranges(last);
  parallelFor(0, last, [&](std::size_t y) {
    const float* lower = map.heights.data() + y * stride;
    ranges[y] = fillTwistRow(lower, lower + stride, stride - 1, map.twists.data() + y * stride);
  });
  std::fill_n(map.twists.data() + last * stride, stride, 0.F);
  for (const auto& [least, most] : ranges) {
    map.lowestTwist = std::min(map.lowestTwist, least);
    map.highestTwist = std::max(map.highestTwist, most);
  }
}

}  // namespace

Node PaddedMap::folded(Node node) const {
  if (wrap == Wrap::clamp) return node;
  return {foldedOffset(node.x, width), foldedOffset(node.y, height)};
}

PaddedMap padMap(const HeightField& field, double radius) {
  const double highest = field.maximum();
  const double lowest = field.minimum();
  const double middle = 0.5 * (lowest + highest);
  PaddedMap map;
  map.width = field.width();
  map.height = field.height();
  map.wrap = field.wrap();
  map.marginX = static_cast<std::ptrdiff_t>(marginOf(map.width, radius, map.wrap));
  map.marginY = static_cast<std::ptrdiff_t>(marginOf(map.height, radius, map.wrap));
  map.stride = map.width + 2 * map.marginX + overhang;
  map.rows = map.height + 2 * map.marginY + 1;
  map.maximum = static_cast<float>(highest - middle);
  map.tolerance = 0x1p-20F * static_cast<float>(highest - lowest);
  const auto texels = static_cast<std::size_t>(map.stride * map.rows);
  map.heights = RawVector<float>(texels);
  map.twists = RawVector<float>(texels);
  fillHeights(field, middle, map);
  fillTwists(map);
  return map;
}

double paddedMapBytes(const HeightField& field, double radius) {
  const double width = field.width() + 2 * marginOf(field.width(), radius, field.wrap());
  const double height = field.height() + 2 * marginOf(field.height(), radius, field.wrap());
  return 2 * sizeof(float) * (width + overhang) * (height + 1);
}

}  // namespace gnomon
