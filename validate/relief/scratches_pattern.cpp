#include "relief/scratches_pattern.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "common/random_stream.h"
#include "relief/pattern_parts.h"

namespace gnomon::relief {
namespace {

struct Scratch {
  Vec2 middle, direction;  ///< texels; unit
  double halfLength, halfWidth, depth;

  /// Share of the full depth at a place, at most 1; below 0 outside the groove.
  [[nodiscard]] double groove(Vec2 place) const {
    const Vec2 from = place - middle;
    const double along = std::clamp(glm::dot(from, direction), -halfLength, halfLength);
    const Vec2 apart = from - along * direction;
    return 1 - glm::dot(apart, apart) / (halfWidth * halfWidth);
  }
};

/// From and to which whole number the texel centres k + ½ lie within a range.
struct TexelRange {
  int first, last;
  TexelRange(double least, double most)
      : first(static_cast<int>(std::ceil(least - 0.5))),
        last(static_cast<int>(std::floor(most - 0.5))) {}
};

/// The texels of one row that a scratch can reach: within the strip about its line.
TexelRange columnsIn(const Scratch& scratch, double y) {
  const double reach = scratch.halfLength + scratch.halfWidth;
  double middle = scratch.middle.x;
  double half = reach;
  const double rise = std::abs(scratch.direction.y);
  if (rise > 0 && scratch.halfWidth / rise < reach) {
    // Where the row meets the line, and the strip's width along the row.
    middle += (y - scratch.middle.y) * scratch.direction.x / scratch.direction.y;
    half = scratch.halfWidth / rise;
  }
  return {middle - half, middle + half};
}

class Depths {
 public:
  Depths(int width, int height)
      : width_(width),
        height_(height),
        depths_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

  void cut(const Scratch& scratch) {
    const double reach = scratch.halfLength + scratch.halfWidth;
    const TexelRange rows(scratch.middle.y - reach, scratch.middle.y + reach);
    for (int j = rows.first; j <= rows.last; ++j) {
      const TexelRange columns = columnsIn(scratch, j + 0.5);
      for (int i = columns.first; i <= columns.last; ++i) {
        double& deepest = at(i, j);
        deepest = std::max(deepest, scratch.depth * scratch.groove({i + 0.5, j + 0.5}));
      }
    }
  }

  [[nodiscard]] double& at(int i, int j) {
    const auto x = static_cast<std::size_t>(wrappedIndex(i, width_, Wrap::repeat));
    const auto y = static_cast<std::size_t>(wrappedIndex(j, height_, Wrap::repeat));
    return depths_[y * static_cast<std::size_t>(width_) + x];
  }

 private:
  int width_, height_;
  std::vector<double> depths_;
};

/// A unit vector, uniform over all directions, without trigonometry: a point of the disc's ring.
Vec2 drawDirection(RandomStream& random) {
  while (true) {
    const double x = 2 * random.unit() - 1;
    const double y = 2 * random.unit() - 1;
    const double square = x * x + y * y;
    if (square > 0.01 && square <= 1) return Vec2(x, y) / std::sqrt(square);
  }
}

}  // namespace

HeightField makeScratches(int width, int height, const ScratchesPattern& pattern, double amplitude,
                          Wrap wrap) {
  requireMap(width, height, amplitude);
  constexpr double longest = 16384;
  constexpr double densest = 4;
  requireBetween("length", pattern.length, 1, longest);
  requireBetween("width", pattern.width, 1, longest);
  requireBetween("density", pattern.density, 1e-6, densest);
  constexpr double meanLength = 0.625;  // of the longest
  const double area = static_cast<double>(width) * height;
  const double count = std::max(
      1.0, std::round(pattern.density * area / (meanLength * pattern.length * pattern.width)));
  Depths depths(width, height);
  RandomStream random(static_cast<std::uint64_t>(pattern.seed));
  for (double i = 0; i < count; ++i) {
    Scratch scratch{};
    scratch.middle.x = random.unit() * width;
    scratch.middle.y = random.unit() * height;
    scratch.direction = drawDirection(random);
    scratch.halfLength = pattern.length * (0.25 + 0.75 * random.unit()) / 2;
    scratch.halfWidth = pattern.width / 2;
    scratch.depth = 1 - 0.75 * i / count;
    depths.cut(scratch);
  }
  return sampledMap(width, height, amplitude, wrap, [&](Vec2 centre) {
    return 1 - depths.at(static_cast<int>(centre.x), static_cast<int>(centre.y));
  });
}

}  // namespace gnomon::relief
