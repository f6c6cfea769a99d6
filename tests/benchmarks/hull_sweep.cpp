#include "hull_sweep.h"

#include <cmath>
#include <cstddef>

namespace gnomon::benchmarks {
namespace {

/// Where the lines cross a column, in texels above the row that they start from.
struct Crossed {
  std::size_t column, below, above;  ///< of the texels beside the crossing; rows of the first line
  float share;                       ///< of the upper one
};

/// Two periods of the map: a texel of the first sees a whole one behind itself.
std::vector<Crossed> crossColumns(const relief::HeightField& field, double rise) {
  const auto row = [&](double y) {
    return static_cast<std::size_t>(
        relief::wrappedIndex(static_cast<int>(y), field.height(), relief::Wrap::repeat));
  };
  std::vector<Crossed> columns;
  for (int x = 0; x < 2 * field.width(); ++x) {
    const double y = x * rise;
    const double below = std::floor(y);
    columns.push_back({static_cast<std::size_t>(x % field.width()), row(below), row(below + 1),
                       static_cast<float>(y - below)});
  }
  return columns;
}

struct Point {
  float x, h;
};

/// Whether `far` is seen over `near`, or at the same slope.
bool seesOver(Point from, Point near, Point far) {
  return (near.h - from.h) * (far.x - from.x) <= (far.h - from.h) * (near.x - from.x);
}

/// The convex hull of a line's points so far, the nearest last.
class Hull {
 public:
  explicit Hull(std::size_t most) : points_(most) {}

  void clear() { count_ = 0; }
  /// Drops what a nearer point hides or makes needless. @returns what it sees highest
  Point tangentFrom(Point from) {
    while (count_ > 1 && seesOver(from, points_[count_ - 1], points_[count_ - 2])) --count_;
    return points_[count_ - 1];
  }
  void add(Point point) { points_[count_++] = point; }

 private:
  std::vector<Point> points_;
  std::size_t count_ = 0;
};

}  // namespace

HullHorizons sweepHulls(const relief::HeightField& field, Vec2 direction) {
  const std::vector<Crossed> columns = crossColumns(field, direction.y / direction.x);
  const auto columnLength = static_cast<float>(1 / direction.x);
  const auto width = static_cast<std::size_t>(field.width());
  const auto height = static_cast<std::size_t>(field.height());
  const float* texels = field.texels().data();
  HullHorizons horizons{std::vector<float>(width * height), std::vector<float>(width * height)};
  Hull hull(columns.size());
  for (std::size_t line = 0; line < height; ++line) {
    const auto rowOf = [&](std::size_t row) {
      return line + row < height ? line + row : line + row - height;
    };
    hull.clear();
    for (std::size_t x = columns.size(); x-- > 0;) {
      const Crossed& c = columns[x];
      const std::size_t below = rowOf(c.below) * width + c.column;
      const std::size_t above = rowOf(c.above) * width + c.column;
      const Point here{static_cast<float>(x),
                       texels[below] + c.share * (texels[above] - texels[below])};
      if (x < width) {
        const Point seen = hull.tangentFrom(here);
        const std::size_t texel = c.share < 0.5F ? below : above;
        const float distance = (seen.x - here.x) * columnLength;
        horizons.slope[texel] = (seen.h - here.h) / distance;
        horizons.distance[texel] = distance;
      } else if (x + 1 < columns.size()) {
        (void)hull.tangentFrom(here);
      }
      hull.add(here);
    }
  }
  return horizons;
}

}  // namespace gnomon::benchmarks
