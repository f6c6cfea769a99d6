#include "horizon/kernel/box_maxima.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "common/parallel.h"

namespace gnomon::horizon {
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
