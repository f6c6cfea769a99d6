#include "relief/patterns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "common/vec.h"
#include "relief/pattern_parts.h"

namespace gnomon::relief {
namespace {

/// From a coordinate to the nearest line of a lattice through the cells' centres.
double toCentre(double x, double period) {
  const double within = x - period * std::floor(x / period);
  return within - period / 2;
}

/// How many periods make up a side, or 0 if it is no whole number of them: then nothing repeats.
long long periodsIn(int side, double period) {
  const double count = std::round(side / period);
  const bool whole = count >= 1 && std::abs(count * period - side) <= 1e-9 * side;
  return whole ? static_cast<long long>(count) : 0;
}

/// The jittered points of the cells, one in each square; every second row of squares lies half a
/// square beside the others, as scales do.
struct CellLattice {
  const CellsPattern& pattern;
  long long across, up;  ///< squares after which the points repeat, or 0

  [[nodiscard]] Vec2 point(long long i, long long j) const {
    const long long column = wrapped(i, across);
    const long long row = wrapped(j, up);
    const auto x = static_cast<std::uint32_t>(column);
    const auto y = static_cast<std::uint32_t>(row);
    const auto seed = static_cast<std::uint32_t>(pattern.seed);
    const Vec2 random(hashed(x, y, 2 * seed), hashed(x, y, 2 * seed + 1));
    const double beside = row % 2 == 0 ? 0 : 0.5;
    const Vec2 corner(static_cast<double>(i) + beside, static_cast<double>(j));
    return pattern.period * (corner + 0.5 + pattern.jitter * (random - 0.5));
  }

 private:
  static long long wrapped(long long k, long long count) {
    return count > 0 ? ((k % count) + count) % count : k;
  }
};

/// A position among the cells: how far it is from the nearest point, and from the borders of that
/// point's cell, with the corners rounded.
struct CellPosition {
  double fromCentre, fromBorder;
};

CellPosition cellPosition(const CellLattice& lattice, Vec2 p) {
  const auto column = static_cast<long long>(std::floor(p.x / lattice.pattern.period));
  const auto row = static_cast<long long>(std::floor(p.y / lattice.pattern.period));
  // The two nearest points are less than two squares away, and a row is shifted by less than one.
  std::array<Vec2, 30> points;
  std::size_t count = 0;
  for (long long j = row - 2; j <= row + 2; ++j) {
    for (long long i = column - 3; i <= column + 2; ++i) points[count++] = lattice.point(i, j);
  }
  const auto nearest = std::min_element(points.begin(), points.end(), [p](Vec2 a, Vec2 b) {
    return glm::dot(a - p, a - p) < glm::dot(b - p, b - p);
  });
  std::array<double, points.size()> fromBisectors;
  std::transform(points.begin(), points.end(), fromBisectors.begin(), [&](Vec2 other) {
    const double apart = glm::length(other - *nearest);
    return apart > 0 ? glm::dot(0.5 * (*nearest + other) - p, other - *nearest) / apart
                     : lattice.pattern.period * 10;
  });
  const double softness = 0.3 * lattice.pattern.groove;
  return {glm::length(*nearest - p), std::max(softMinimum(fromBisectors, softness), 0.0)};
}

/// How far crest lines are displaced, between -1 and 1: three waves, a whole number of each across
/// the map.
class Meanders {
 public:
  Meanders(int width, int height, double period)
      : alongX_(2 * pi / width),
        alongY_(2 * pi / height),
        x_{waves(width, 23 * period), waves(width, 11 * period), waves(width, 6 * period)},
        y_{waves(height, 13 * period), waves(height, 6 * period), waves(height, 3.5 * period)} {}

  [[nodiscard]] double at(Vec2 p) const {
    const double u = alongX_ * p.x;
    const double v = alongY_ * p.y;
    return 0.5 * std::sin(y_[0] * v + x_[0] * u) + 0.3 * std::sin(y_[1] * v - x_[1] * u + 1) +
           0.2 * std::sin(y_[2] * v + x_[2] * u + 2);
  }

 private:
  static double waves(int side, double length) { return std::max(1.0, std::round(side / length)); }
  double alongX_, alongY_;
  std::array<double, 3> x_, y_;
};

}  // namespace

HeightField makeColumns(int width, int height, const ColumnsPattern& pattern, double amplitude,
                        Wrap wrap) {
  requireMap(width, height, amplitude);
  requireBetween("period", pattern.period, 1, longestOfPatterns);
  requireBetween("radius", pattern.radius, 0, longestOfPatterns);
  requireBetween("wall", pattern.wall, 0, longestOfPatterns);
  return sampledMap(width, height, amplitude, wrap, [&](Vec2 p) {
    const double beyond =
        std::hypot(toCentre(p.x, pattern.period), toCentre(p.y, pattern.period)) - pattern.radius;
    if (beyond <= 0) return 1.0;
    return beyond < pattern.wall ? 1 - beyond / pattern.wall : 0.0;
  });
}

HeightField makeCosine(int width, int height, const CosinePattern& pattern, double amplitude,
                       Wrap wrap) {
  requireMap(width, height, amplitude);
  requireBetween("period", pattern.period, 1, longestOfPatterns);
  const double phase = 2 * pi / pattern.period;
  return sampledMap(width, height, amplitude, wrap, [phase](Vec2 p) {
    return (2 - std::cos(phase * p.x) - std::cos(phase * p.y)) / 4;
  });
}

HeightField makeCells(int width, int height, const CellsPattern& pattern, double amplitude,
                      Wrap wrap) {
  requireMap(width, height, amplitude);
  requireBetween("period", pattern.period, 1, longestOfPatterns);
  requireBetween("jitter", pattern.jitter, 0, 1);
  requireBetween("groove", pattern.groove, 1e-3, longestOfPatterns);
  const CellLattice lattice{pattern, periodsIn(width, pattern.period),
                            periodsIn(height, pattern.period)};
  return sampledMap(width, height, amplitude, wrap, [&](Vec2 p) {
    const CellPosition at = cellPosition(lattice, p);
    return cellHeight(at.fromCentre, at.fromBorder, pattern.period, pattern.groove);
  });
}

HeightField makeRipples(int width, int height, const RipplesPattern& pattern, double amplitude,
                        Wrap wrap) {
  requireMap(width, height, amplitude);
  requireBetween("period", pattern.period, 1, longestOfPatterns);
  requireBetween("windward", pattern.windward, 0.01, 0.99);
  requireBetween("meander", pattern.meander, 0, longestOfPatterns);
  const Meanders meanders(width, height, pattern.period);
  return sampledMap(width, height, amplitude, wrap, [&](Vec2 p) {
    const double shift = meanders.at(p);
    const double phase = (p.x + pattern.meander * shift) / pattern.period;
    return rippleProfile(phase - std::floor(phase), pattern.windward);
  });
}

}  // namespace gnomon::relief
