#include "horizon/reference/ray_crossings.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::horizon {

namespace {

/// cos and sin of (π/2) · numerator/denominator, 0 ≤ numerator < denominator, from the first octant
/// so that mirrored azimuths are mirrored exactly.
Vec2 inFirstQuadrant(long long numerator, long long denominator) {
  if (numerator == 0) return {1, 0};
  if (2 * numerator == denominator) return {std::sqrt(0.5), std::sqrt(0.5)};
  const bool upper = 2 * numerator > denominator;
  const long long reduced = upper ? denominator - numerator : numerator;
  const double angle = pi / 2 * (static_cast<double>(reduced) / static_cast<double>(denominator));
  const Vec2 e(std::cos(angle), std::sin(angle));
  return upper ? Vec2(e.y, e.x) : e;
}

/// Lattice nodes as the ray sees them: mirrored so that it runs toward +x and +y.
struct Mirror {
  int x, y;
  [[nodiscard]] Node node(int i, int j) const { return {x * i, y * j}; }
  [[nodiscard]] Node cell(int i, int j) const {
    return {x > 0 ? i : -(i + 1), y > 0 ? j : -(j + 1)};
  }
};

}  // namespace

Vec2 azimuthDirection(int azimuth, int azimuths) {
  const long long quarters = 4LL * azimuth;
  const Vec2 e = inFirstQuadrant(quarters % azimuths, azimuths);
  switch ((quarters / azimuths) % 4) {
    case 0:
      return e;
    case 1:
      return {-e.y, e.x};
    case 2:
      return {-e.x, -e.y};
    default:
      return {e.y, -e.x};
  }
}

RayCrossings cutRay(Vec2 direction, double radius, Vec2 offset) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const Vec2 e = glm::abs(direction);
  const Mirror mirror{direction.x < 0 ? -1 : 1, direction.y < 0 ? -1 : 1};
  const Vec2 origin = offset * Vec2(mirror.x, mirror.y);
  RayCrossings ray{direction, {}, radius, {}, 0};
  ray.crossings.reserve(static_cast<std::size_t>(radius * (e.x + e.y)) + 2);
  double r = 0;
  // The next vertical and horizontal line; the ray is in cell (i - 1, j - 1).
  int i = static_cast<int>(std::floor(origin.x)) + 1;
  int j = static_cast<int>(std::floor(origin.y)) + 1;
  while (true) {
    const double vertical = e.x > 0 ? (i - origin.x) / e.x : never;
    const double horizontal = e.y > 0 ? (j - origin.y) / e.y : never;
    const double next = std::min(vertical, horizontal);
    if (next > radius) break;
    Crossing c{r, next, mirror.cell(i - 1, j - 1), {}, {}, 0};
    if (vertical == horizontal) {
      c.from = c.to = mirror.node(i++, j++);
    } else if (vertical < horizontal) {
      c.from = mirror.node(i, j - 1);
      c.to = mirror.node(i, j);
      c.share = std::clamp(origin.y + (i - origin.x) * (e.y / e.x) - (j - 1), 0.0, 1.0);
      ++i;
    } else {
      c.from = mirror.node(i - 1, j);
      c.to = mirror.node(i, j);
      c.share = std::clamp(origin.x + (j - origin.y) * (e.x / e.y) - (i - 1), 0.0, 1.0);
      ++j;
    }
    ray.crossings.push_back(c);
    r = next;
  }
  ray.lastCell = mirror.cell(i - 1, j - 1);
  ray.lastEnter = r;
  return ray;
}

namespace {

double layerValue(const StoredTable& table, const TableShape& shape, Vec2 texel, int azimuth) {
  const relief::Neighbours column =
      relief::neighbours(texel.x, shape.width, shape.border.x ? relief::Wrap::clamp : shape.wrap);
  const relief::Neighbours row =
      relief::neighbours(texel.y, shape.height, shape.border.y ? relief::Wrap::clamp : shape.wrap);
  const auto entry = [&](int x, int y) {
    return static_cast<double>(table.value(shape.entry(azimuth, x, y)));
  };
  const double low = (1 - column.share) * entry(column.first, row.first) +
                     column.share * entry(column.second, row.first);
  const double high = (1 - column.share) * entry(column.first, row.second) +
                      column.share * entry(column.second, row.second);
  return (1 - row.share) * low + row.share * high;
}

}  // namespace

double filteredValue(const StoredTable& table, const TableShape& shape, Vec2 texel,
                     double azimuth) {
  const double turns = azimuth / (2 * pi);
  const double place = (turns - std::floor(turns)) * shape.layers;
  const int below = static_cast<int>(place);
  const double share = place - below;
  return (1 - share) * layerValue(table, shape, texel, below % shape.layers) +
         share * layerValue(table, shape, texel, (below + 1) % shape.layers);
}

}  // namespace gnomon::horizon
