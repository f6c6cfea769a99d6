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

/// Reliefs as functions, sampled at texel centres; values 0 to 1 times `height`. All tile where
/// `period` divides the map's sides. Lengths in texels. See each for its formula.

/// Cylindrical columns at the centres of a square lattice (Figure 4 of Onoue, Max & Nishita 2004):
/// 1 within `radius` of a centre, 0 outside radius + wall, linear between. Centres lie at
/// (i + ½, j + ½) periods.
struct ColumnsPattern {
  double period = 32;
  double radius = 8;
  double wall = 1;
};

/// (2 - cos(2πx/period) - cos(2πy/period)) / 4.
struct CosinePattern {
  double period = 32;
};

/// Reptile skin: rounded scales parted by grooves, the cells of a jittered lattice of points (from
/// `seed`), one a period × period square, every second row of squares shifted by half a square.
/// With F1 the distance to the nearest point P (Worley 1996) and b_i
/// the distances to the bisectors between P and the other points P_i,
///   b = -s log Σ exp(-b_i / s), s = 0.3 groove, at least 0: to the border, with rounded corners
///   smoothstep(b / groove) · (1 - 0.6 (F1 / period)²): a rim as wide as `groove`, a domed top.
struct CellsPattern {
  double period = 32;
  double jitter = 0.5;  ///< 0 to 1: share of its square in which a point may lie
  double groove = 6;
  int seed = 1;  ///< 0 or more
};

/// Wind ripples on sand: asymmetric ridges across x. With t the fractional part of
/// (x + meander · w(x, y)) / period:
///   t < windward: sin(π/2 · t / windward)^1.5, the gentle side
///   else ((1 - t) / (1 - windward))^1.5, the lee, steepest at the crest.
/// w, between -1 and 1, is the sum of three sine waves of which a whole number fits on each side of
/// the map, about 13, 6 and 3.5 periods long in y and 23, 11 and 6 in x.
struct RipplesPattern {
  double period = 16;
  double windward = 0.7;  ///< 0.01 to 0.99: share of the wavelength that rises
  double meander = 6;     ///< texels that crest lines stray at most
};

/// @throws InputError naming the parameter: a period under 1 texel, a length that is negative or
///   over 1e9, a share out of range, an amplitude that is not finite; MemoryError
HeightField makeColumns(int width, int height, const ColumnsPattern&, double amplitude, Wrap);
HeightField makeCosine(int width, int height, const CosinePattern&, double amplitude, Wrap);
HeightField makeCells(int width, int height, const CellsPattern&, double amplitude, Wrap);
HeightField makeRipples(int width, int height, const RipplesPattern&, double amplitude, Wrap);

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

/// 3t² - 2t³ of t = x, clamped to 0 … 1.
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

/// A polished surface with scratches: straight grooves at random places, in random directions. At a
/// texel the height is 1 less the deepest groove there; with r the distance to a scratch's segment
/// its groove is
///   depth · (1 - (2r / width)²), at least 0: a parabola across, rounded at the ends.
/// There are n = round(density · width of the map · height of the map / (⅝ · length · width)) of
/// them, at least one. Scratch i of n, from 0, has depth 1 - ¾ i/n; middle, direction and length,
/// from ¼ to 1 of `length`, are uniformly random from `seed`. The map tiles whatever its sides are.
struct ScratchesPattern {
  double density = 0.3;  ///< share of the map that they would cover if they did not overlap
  double length = 64;    ///< texels: of the longest
  double width = 6;      ///< texels
  int seed = 1;          ///< 0 or more
};

/// @throws InputError naming the key: a length under a texel or over 16,384, a density that is not
///   above 0 or over 4; MemoryError
HeightField makeScratches(int width, int height, const ScratchesPattern&, double amplitude, Wrap);

/// Rough ground: a random field whose power spectrum is f^-β, by spectral synthesis (Peitgen &
/// Saupe 1988). Over all waves (k, l) of which whole numbers fit on the map, one of each pair
/// ±(k, l), with f = |(k / width, l / height)| from 1 / period to 1 / shortest cycles a texel,
///   Σ f^(-β/2) cos(2π (k x / width + l y / height) + φ_kl),
/// φ_kl random from `seed`; then moved and scaled so that the map runs from 0 to 1. f^-β is power
/// for an area of the plane of frequencies; a profile along a line has f^-(β - 1). The map tiles
/// whatever its sides are.
struct SpectrumPattern {
  double beta = 3;      ///< 0 to 10: 0 is noise, 2 to 4 natural ground (Mandelbrot 1982)
  double period = 64;   ///< texels: of the longest wave
  double shortest = 4;  ///< texels: of the shortest wave, at least 2
  int seed = 1;         ///< 0 or more
};

/// In O(n Σ p) for n texels and the prime factors p of the map's sides (Cooley & Tukey 1965).
/// @throws InputError naming the key: a length or exponent out of range, or no wave that fits;
///   MemoryError
HeightField makeSpectrum(int width, int height, const SpectrumPattern&, double amplitude, Wrap);

}  // namespace gnomon::relief
