#include "horizon/kernel/padded_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

namespace {

void raise(float* to, const float* from, std::size_t count) {
  for (std::size_t x = 0; x < count; ++x) to[x] = from[x] > to[x] ? from[x] : to[x];
}

/// Where the texels right of the end of a row stand in it, or -1 if no ray meets them.
std::ptrdiff_t columnIn(const PaddedMap& map, std::ptrdiff_t x) {
  if (x < map.stride) return x;
  if (!map.repeatsX) return -1;
  return x - (x - map.stride + map.width) / map.width * map.width;
}

/// The same for rows.
std::ptrdiff_t rowIn(const PaddedMap& map, std::ptrdiff_t y) {
  if (!map.repeatsY) return y < map.rows ? y : -1;
  return map.marginY +
         relief::wrappedIndex(static_cast<int>(y - map.marginY), map.height, relief::Wrap::repeat);
}

/// Maxima of `to` neighbours in a row from those of `from` neighbours.
void widenRow(const PaddedMap& map, const float* row, int from, int to, std::vector<float>& buffer,
              float* out) {
  const auto stride = static_cast<std::size_t>(map.stride);
  std::size_t length = stride + static_cast<std::size_t>(to - from);
  buffer.resize(length);
  std::copy_n(row, stride, buffer.begin());
  for (std::size_t x = stride; x < length; ++x) {
    const std::ptrdiff_t column = columnIn(map, static_cast<std::ptrdiff_t>(x));
    buffer[x] = column < 0 ? -std::numeric_limits<float>::infinity() : row[column];
  }
  for (int size = from; size < to;) {
    const int step = std::min(size, to - size);
    length -= static_cast<std::size_t>(step);
    raise(buffer.data(), buffer.data() + step, length);
    size += step;
  }
  std::copy_n(buffer.begin(), stride, out);
}

/// @param values  maxima of boxes of size `from`, every row
BoxMaxima grow(const PaddedMap& map, const float* values, BoxSize from, BoxSize box, int rowShift) {
  const auto stride = static_cast<std::size_t>(map.stride);
  const auto rowStep = std::ptrdiff_t{1} << rowShift;
  const auto rows = static_cast<std::size_t>((map.rows + rowStep - 1) / rowStep);
  RawVector<float> wide(stride * static_cast<std::size_t>(map.rows));
  // The rows that `rowIn` names.
  const auto first = static_cast<std::size_t>(map.repeatsY ? map.marginY : 0);
  const auto count = static_cast<std::size_t>(map.repeatsY ? map.height : map.rows);
  parallelFor(first, first + count, [&](std::size_t y) {
    std::vector<float> buffer;
    widenRow(map, values + y * stride, from.width, box.width, buffer, wide.data() + y * stride);
  });
  BoxMaxima result{box, rowShift, RawVector<float>(stride * rows)};
  const int tall = box.height + static_cast<int>(rowStep) - 1;
  parallelFor(0, rows, [&](std::size_t j) {
    float* out = result.highest.data() + j * stride;
    const std::ptrdiff_t y = static_cast<std::ptrdiff_t>(j) * rowStep;
    std::copy_n(wide.data() + static_cast<std::size_t>(rowIn(map, y)) * stride, stride, out);
    for (int covered = from.height; covered < tall; covered += from.height) {
      const std::ptrdiff_t row = rowIn(map, y + std::min(covered, tall - from.height));
      if (row >= 0) raise(out, wide.data() + static_cast<std::size_t>(row) * stride, stride);
    }
  });
  return result;
}

}  // namespace

BoxMaxima boxMaxima(const PaddedMap& map, BoxSize box, int rowShift) {
  return grow(map, map.heights.data(), {1, 1}, box, rowShift);
}

BoxMaxima boxMaxima(const PaddedMap& map, const BoxMaxima& from, BoxSize box, int rowShift) {
  return grow(map, from.highest.data(), from.box, box, rowShift);
}

}  // namespace gnomon::horizon
