#include "relief/spectrum_pattern.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/error.h"
#include "common/parallel.h"
#include "common/system/memory.h"
#include "relief/pattern_parts.h"

namespace gnomon::relief {
namespace {

using Complex = std::complex<double>;

Complex times(Complex a, Complex b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

std::size_t leastPrimeFactor(std::size_t n) {
  for (std::size_t p = 2; p * p <= n; ++p) {
    if (n % p == 0) return p;
  }
  return n;
}

/// Sums of waves along a line of n texels: out[x] = Σ_k in[k] e^(2πi kx / n), from those of the
/// interleaved parts of the line.
class WaveSum {
 public:
  explicit WaveSum(std::size_t n) : roots_(n) {
    for (std::size_t k = 0; k < n; ++k) {
      roots_[k] = std::polar(1.0, 2 * pi * static_cast<double>(k) / static_cast<double>(n));
    }
  }

  void operator()(const Complex* in, Complex* out) const { sum(in, 1, out, roots_.size()); }

 private:
  void sum(const Complex* in, std::size_t stride, Complex* out, std::size_t n) const {
    if (n == 1) {
      *out = *in;
      return;
    }
    const std::size_t parts = leastPrimeFactor(n);
    const std::size_t length = n / parts;
    for (std::size_t part = 0; part < parts; ++part) {
      sum(in + part * stride, stride * parts, out + part * length, length);
    }
    std::vector<Complex> terms(parts);
    for (std::size_t k = 0; k < length; ++k) {
      for (std::size_t part = 0; part < parts; ++part) terms[part] = out[part * length + k];
      for (std::size_t block = 0; block < parts; ++block) {
        const std::size_t x = block * length + k;
        Complex value = terms[0];
        for (std::size_t part = 1; part < parts; ++part) {
          value += times(terms[part], roots_[part * x % n * stride]);
        }
        out[x] = value;
      }
    }
  }

  std::vector<Complex> roots_;
};

/// The waves of a map, row by row of l: amplitude and phase at the centre of texel (0, 0).
std::vector<Complex> wavesOf(std::size_t width, std::size_t height, const SpectrumPattern& made) {
  std::vector<Complex> waves(width * height);
  const double least = 1 / made.period * (1 - 1e-12);  // the limits themselves, whatever rounding
  const double most = 1 / made.shortest * (1 + 1e-12);
  parallelFor(0, height / 2 + 1, [&](std::size_t l) {
    for (std::size_t i = 0; i < width; ++i) {
      // i counts k = 0, 1, … and from the end -1, -2, …
      const bool isNegative = 2 * i > width;
      if (l == 0 && (i == 0 || isNegative)) continue;
      const double k = static_cast<double>(i) - (isNegative ? static_cast<double>(width) : 0);
      const double across = k / static_cast<double>(width);
      const double up = static_cast<double>(l) / static_cast<double>(height);
      const double f = std::hypot(across, up);
      if (!(f >= least && f <= most)) continue;
      const double turn =
          hashed(static_cast<std::uint32_t>(static_cast<std::int64_t>(k)),
                 static_cast<std::uint32_t>(l), static_cast<std::uint32_t>(made.seed));
      waves[l * width + i] =
          std::polar(std::pow(f, -made.beta / 2), 2 * pi * (turn + (across + up) / 2));
    }
  });
  return waves;
}

void requireWaves(const std::vector<Complex>& waves, const SpectrumPattern& made) {
  if (std::any_of(waves.begin(), waves.end(), [](Complex wave) { return wave != 0.0; })) return;
  throw InputError(
      fmt::format("no wave from {} to {} texels long fits a whole number of times on the map",
                  made.shortest, made.period),
      "period");
}

}  // namespace

HeightField makeSpectrum(int width, int height, const SpectrumPattern& pattern, double amplitude,
                         Wrap wrap) {
  requireMap(width, height, amplitude);
  requireBetween("beta", pattern.beta, 0, 10);
  requireBetween("shortest", pattern.shortest, 2, longestOfPatterns);
  requireBetween("period", pattern.period, pattern.shortest, longestOfPatterns);
  const auto columns = static_cast<std::size_t>(width);
  const auto rows = static_cast<std::size_t>(height);
  requireMemory(2.0 * static_cast<double>(columns) * static_cast<double>(rows) * sizeof(Complex),
                fmt::format("a spectrum of {} × {} texels", width, height));
  const std::vector<Complex> waves = wavesOf(columns, rows, pattern);
  requireWaves(waves, pattern);

  std::vector<Complex> half(waves.size());  // summed over l, column by column
  const WaveSum up(rows);
  parallelFor(0, columns, [&](std::size_t k) {
    std::vector<Complex> line(rows);
    for (std::size_t l = 0; l < rows; ++l) line[l] = waves[l * columns + k];
    up(line.data(), &half[k * rows]);
  });
  std::vector<double> sums(waves.size());
  const WaveSum across(columns);
  parallelFor(0, rows, [&](std::size_t y) {
    std::vector<Complex> line(columns);
    std::vector<Complex> sum(columns);
    for (std::size_t k = 0; k < columns; ++k) line[k] = half[k * rows + y];
    across(line.data(), sum.data());
    for (std::size_t x = 0; x < columns; ++x) sums[y * columns + x] = sum[x].real();
  });
  const auto [least, most] = std::minmax_element(sums.begin(), sums.end());
  const double low = *least;
  const double range = *most > low ? *most - low : 1;
  return sampledMap(width, height, amplitude, wrap, [&](Vec2 centre) {
    const auto x = static_cast<std::size_t>(centre.x);
    const auto y = static_cast<std::size_t>(centre.y);
    return (sums[y * columns + x] - low) / range;
  });
}

}  // namespace gnomon::relief
