#include "horizon/kernel/padded_map.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "common/parallel.h"

namespace gnomon::horizon {
namespace {

/// Texels that a row is longer than it need be, so that whole vectors can be read at its end.
constexpr std::ptrdiff_t overhang = 64;

/// Times the map's range: how far below the map the nodes past a border lie.
constexpr float depth = 0x1p12F;

/// One axis of a map.
struct Axis {
  int side;
  relief::Wrap wrap;
  bool border;
  [[nodiscard]] bool repeats() const { return wrap == relief::Wrap::repeat && !border; }
  /// Whether a node is past what is known.
  [[nodiscard]] bool isUnknown(int node) const { return border && (node < -1 || node > side); }
};

Axis axisX(const relief::HeightField& field) {
  return {field.width(), field.wrap(), field.border().x};
}

Axis axisY(const relief::HeightField& field) {
  return {field.height(), field.wrap(), field.border().y};
}

/// Also of the four nodes of a cell, whose lower left one was folded.
double marginOf(const Axis& axis, double radius) {
  const double margin = std::ceil(radius) + 2;
  const int half = axis.side / 2;
  return axis.repeats() ? std::min(margin, half + 2.0) : margin;
}

/// The representative of an offset, modulo a side, from -side/2 on.
int foldedOffset(int offset, int side) {
  const int half = side / 2;
  return relief::wrappedIndex(offset + half, side, relief::Wrap::repeat) - half;
}

void fillHeights(const relief::HeightField& field, double middle, PaddedMap& map) {
  const Axis across = axisX(field);
  const Axis up = axisY(field);
  const float unknown = -map.maximum - depth * 2 * map.maximum;
  const auto stride = static_cast<std::size_t>(map.stride);
  std::vector<std::size_t> columns(stride);
  std::size_t firstKnown = stride;
  std::size_t endKnown = 0;
  for (std::size_t x = 0; x < stride; ++x) {
    const int i = static_cast<int>(static_cast<std::ptrdiff_t>(x) - map.marginX);
    columns[x] = static_cast<std::size_t>(relief::wrappedIndex(i, across.side, across.wrap));
    if (across.isUnknown(i)) continue;
    firstKnown = std::min(firstKnown, x);
    endKnown = x + 1;
  }
  parallelFor(0, static_cast<std::size_t>(map.rows), [&](std::size_t y) {
    const int node = static_cast<int>(static_cast<std::ptrdiff_t>(y) - map.marginY);
    float* out = map.heights.data() + y * stride;
    if (up.isUnknown(node)) {
      std::fill_n(out, stride, unknown);
      return;
    }
    const auto j = static_cast<std::size_t>(relief::wrappedIndex(node, up.side, up.wrap));
    const float* row = field.texels().data() + j * static_cast<std::size_t>(across.side);
    std::fill(out, out + firstKnown, unknown);
    for (std::size_t x = firstKnown; x < endKnown; ++x) {
      out[x] = static_cast<float>(row[columns[x]] - middle);
    }
    std::fill(out + endKnown, out + stride, unknown);
  });
}

using Range = std::pair<float, float>;

/// @returns the lowest and the highest twist of the row
Range fillTwistRow(const float* lower, const float* upper, std::size_t count, float largest,
                   float* out) {
  float least = 0;
  float most = 0;
  for (std::size_t x = 0; x < count; ++x) {
    const float twist = (lower[x] - lower[x + 1]) - (upper[x] - upper[x + 1]);
    out[x] = std::abs(twist) <= largest ? twist : 0;
    least = std::min(least, out[x]);
    most = std::max(most, out[x]);
  }
  out[count] = 0;
  return {least, most};
}

void fillTwists(PaddedMap& map) {
  const auto stride = static_cast<std::size_t>(map.stride);
  const auto last = static_cast<std::size_t>(map.rows - 1);
  // Four known heights differ by twice the range at most; one by itself past two borders by more.
  const float largest = 8 * map.maximum;
  std::vector<Range> ranges(last);
  parallelFor(0, last, [&](std::size_t y) {
    const float* lower = map.heights.data() + y * stride;
    ranges[y] =
        fillTwistRow(lower, lower + stride, stride - 1, largest, map.twists.data() + y * stride);
  });
  std::fill_n(map.twists.data() + last * stride, stride, 0.F);
  for (const auto& [least, most] : ranges) {
    map.lowestTwist = std::min(map.lowestTwist, least);
    map.highestTwist = std::max(map.highestTwist, most);
  }
}

}  // namespace

Node PaddedMap::folded(Node node) const {
  return {repeatsX ? foldedOffset(node.x, width) : node.x,
          repeatsY ? foldedOffset(node.y, height) : node.y};
}

PaddedMap padMap(const relief::HeightField& field, double radius) {
  const double highest = field.maximum();
  const double lowest = field.minimum();
  const double middle = 0.5 * (lowest + highest);
  PaddedMap map;
  map.width = field.width();
  map.height = field.height();
  map.repeatsX = axisX(field).repeats();
  map.repeatsY = axisY(field).repeats();
  map.marginX = static_cast<std::ptrdiff_t>(marginOf(axisX(field), radius));
  map.marginY = static_cast<std::ptrdiff_t>(marginOf(axisY(field), radius));
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

double paddedMapBytes(const relief::HeightField& field, double radius) {
  const double width = field.width() + 2 * marginOf(axisX(field), radius);
  const double height = field.height() + 2 * marginOf(axisY(field), radius);
  return 2 * sizeof(float) * (width + overhang) * (height + 1);
}

}  // namespace gnomon::horizon
