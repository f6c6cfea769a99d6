#include "relief/solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "common/error.h"
#include "common/overloaded.h"
#include "relief/pattern_parts.h"

namespace gnomon::relief {
namespace {

using Cell = glm::vec<3, std::int64_t>;

Cell cellOf(const Vec3& p) {
  return Cell(glm::floor(p));
}

/// A number in [0, 1) for a point of a lattice.
double hashedCell(const Cell& cell, std::uint32_t salt) {
  const auto word = [](std::int64_t k) { return static_cast<std::uint32_t>(k); };
  // The third coordinate goes in by way of the salt, mixed by itself first.
  const double third = hashed(word(cell.z), salt, 0x5BD1E995U);
  return hashed(word(cell.x), word(cell.y), static_cast<std::uint32_t>(third * 0x1p32));
}

/// The dot product with one of the twelve edges of a cube (Perlin 2002).
double alongEdge(std::size_t edge, const Vec3& v) {
  const std::size_t zero = edge / 4;  // the axis that the edge's direction has nothing of
  const double a = v[static_cast<int>((zero + 1) % 3)];
  const double b = v[static_cast<int>((zero + 2) % 3)];
  return (edge % 2 == 0 ? a : -a) + (edge / 2 % 2 == 0 ? b : -b);
}

double fade(double t) {
  return t * t * t * (t * (6 * t - 15) + 10);
}

/// Gradient noise of period 1, about -1 to 1.
double noise(const Vec3& p, std::uint32_t salt) {
  const Cell cell = cellOf(p);
  const Vec3 within = p - Vec3(cell);
  const Vec3 share(fade(within.x), fade(within.y), fade(within.z));
  double value = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Cell step(corner & 1, corner >> 1 & 1, corner >> 2);
    const auto edge = static_cast<std::size_t>(12 * hashedCell(cell + step, salt));
    double weight = 1;
    for (int axis = 0; axis < 3; ++axis) {
      weight *= step[axis] == 1 ? share[axis] : 1 - share[axis];
    }
    value += weight * alongEdge(edge, within - Vec3(step));
  }
  return value;
}

double noiseHeight(const SolidNoise& made, const Vec3& point) {
  double sum = 0;
  double weights = 0;
  double weight = 1;
  double frequency = 1 / made.period;
  for (int octave = 0; octave < made.octaves; ++octave) {
    // Shifted, so that the lattices of two octaves have no point in common where all is 0.
    const Vec3 shift = static_cast<double>(octave) * Vec3(0.37, 0.71, 0.13);
    const auto salt = static_cast<std::uint32_t>(made.seed) * 31U + static_cast<unsigned>(octave);
    sum += weight * noise(frequency * point + shift, salt);
    weights += weight;
    weight *= made.gain;
    frequency *= 2;
  }
  return std::clamp(0.5 + 0.5 * sum / weights, 0.0, 1.0);
}

/// The jittered point of a cube, in periods.
Vec3 pointOf(const SolidCells& made, const Cell& cell) {
  const std::uint32_t salt = 3 * static_cast<std::uint32_t>(made.seed);
  const Vec3 random(hashedCell(cell, salt), hashedCell(cell, salt + 1), hashedCell(cell, salt + 2));
  return Vec3(cell) + 0.5 + made.jitter * (random - 0.5);
}

double cellsHeight(const SolidCells& made, const Vec3& point) {
  const Vec3 p = point / made.period;
  const Cell home = cellOf(p);
  // The two nearest points are less than two cubes away.
  constexpr int reach = 2;
  constexpr std::size_t side = 2 * reach + 1;
  std::array<Vec3, side * side * side> points;
  std::size_t count = 0;
  for (int z = -reach; z <= reach; ++z) {
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) points[count++] = pointOf(made, home + Cell(x, y, z));
    }
  }
  const auto nearest = std::min_element(points.begin(), points.end(), [&p](auto& a, auto& b) {
    return glm::dot(a - p, a - p) < glm::dot(b - p, b - p);
  });
  std::array<double, points.size()> fromBisectors;
  std::transform(points.begin(), points.end(), fromBisectors.begin(), [&](const Vec3& other) {
    const double apart = glm::length(other - *nearest);
    return apart > 0 ? glm::dot(0.5 * (*nearest + other) - p, other - *nearest) / apart : 10.0;
  });
  const double groove = made.groove / made.period;
  const double fromBorder = std::max(softMinimum(fromBisectors, 0.3 * groove), 0.0);
  return cellHeight(glm::length(*nearest - p), fromBorder, 1, groove);
}

}  // namespace

SolidFunction solidFunction(const SolidPattern& solid) {
  return std::visit(
      Overloaded{[](const SolidNoise& made) -> SolidFunction {
                   requireLength("period", made.period);
                   requireBetween("octaves", made.octaves, 1, 16);
                   requireBetween("gain", made.gain, 0, 1);
                   return [made](const Vec3& point) { return noiseHeight(made, point); };
                 },
                 [](const SolidCells& made) -> SolidFunction {
                   requireLength("period", made.period);
                   requireBetween("jitter", made.jitter, 0, 1);
                   requireLength("groove", made.groove);
                   return [made](const Vec3& point) { return cellsHeight(made, point); };
                 },
                 [](const SolidRipples& made) -> SolidFunction {
                   requireLength("period", made.period);
                   requireBetween("windward", made.windward, 0.01, 0.99);
                   requireBetween("meander", made.meander, 0, longestOfPatterns);
                   const double length = glm::length(made.direction);
                   if (!(length > 0)) throw InputError("a vector of length 0 found", "direction");
                   const Vec3 direction = made.direction / length;
                   const SolidNoise meanders{4 * made.period, 1, 0.5, made.seed};
                   return [made, direction, meanders](const Vec3& point) {
                     const double shift = 2 * noiseHeight(meanders, point) - 1;
                     const double phase =
                         (glm::dot(point, direction) + made.meander * shift) / made.period;
                     return rippleProfile(phase - std::floor(phase), made.windward);
                   };
                 }},
      solid);
}

}  // namespace gnomon::relief
