#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "common/parallel.h"
#include "common/vec.h"
#include "relief/height_field.h"

namespace gnomon::relief {

/// What patterns of the plane and of space are made of.

/// Texels or world units: coordinates stay exact far beyond any map.
constexpr double longestOfPatterns = 1e9;

/// @throws InputError naming the parameter, for a value that is not between the two
void requireBetween(const std::string& parameter, double value, double least, double most);

/// The same for a length: above 0, up to `longestOfPatterns`.
inline void requireLength(const std::string& parameter, double value) {
  requireBetween(parameter, value, 1 / longestOfPatterns, longestOfPatterns);
}

/// @throws InputError for a size that is not positive or an amplitude that is not finite;
///   MemoryError for a map that cannot fit
void requireMap(int width, int height, double amplitude);

/// amplitude × function at every texel centre.
template <typename Function>
HeightField sampledMap(int width, int height, double amplitude, Wrap wrap,
                       const Function& function) {
  std::vector<float> texels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  parallelFor(0, static_cast<std::size_t>(height), [&](std::size_t row) {
    for (int x = 0; x < width; ++x) {
      const Vec2 centre(x + 0.5, static_cast<double>(row) + 0.5);
      texels[row * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] =
          static_cast<float>(amplitude * function(centre));
    }
  });
  return {width, height, std::move(texels), wrap};
}

/// 3t² - 2t³ of t = x, held within 0 and 1.
inline double smoothstep(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// A number in [0, 1) for a lattice point. An integer hash (the mixing steps are those of Murmur
/// 3's finaliser), so that it is the same on every machine.
inline double hashed(std::uint32_t x, std::uint32_t y, std::uint32_t salt) {
  std::uint32_t h = x * 0x9E3779B1U ^ (y + 0x7F4A7C15U) * 0x85EBCA77U ^ salt * 0xC2B2AE3DU;
  h = (h ^ (h >> 16)) * 0x85EBCA6BU;
  h = (h ^ (h >> 13)) * 0xC2B2AE35U;
  h ^= h >> 16;
  return h * 0x1p-32;
}

/// -s log Σ exp(-v / s): the least of the values, or up to a few s less where several are near it.
template <typename Values>
double softMinimum(const Values& values, double s) {
  const double least = *std::min_element(values.begin(), values.end());
  double sum = 0;
  for (const double v : values) sum += std::exp((least - v) / s);
  return least - s * std::log(sum);
}

/// The height of a cell of a lattice, see CellsPattern.
/// @param fromCentre  distance to its point
/// @param fromBorder  to its border, with rounded corners, at least 0
inline double cellHeight(double fromCentre, double fromBorder, double period, double groove) {
  const double away = std::min(fromCentre / period, 1.0);
  return smoothstep(fromBorder / groove) * (1 - 0.6 * away * away);
}

/// A ripple from trough (t = 0) over the crest (t = windward) to the next trough (t = 1): rounded
/// in the trough, bulging to windward, with an edge at the crest where the sand slides down.
inline double rippleProfile(double t, double windward) {
  if (t < windward) return std::pow(std::sin(pi / 2 * t / windward), 1.5);
  return std::pow((1 - t) / (1 - windward), 1.5);
}

}  // namespace gnomon::relief
