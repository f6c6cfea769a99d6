#pragma once

#include "relief/height_field.h"

namespace gnomon::relief {

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
