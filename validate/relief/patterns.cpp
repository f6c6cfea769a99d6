#include "relief/patterns.h"

#include <fmt/core.h>

#include <array>
#include <complex>

#include "common/error.h"
#include "common/random_stream.h"
#include "common/system/memory.h"

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

void requireBetween(const std::string& parameter, double value, double least, double most) {
  if (!(value >= least && value <= most)) {
    throw InputError(fmt::format("{} found, {} to {} expected", value, least, most), parameter);
  }
}

void requireMap(int width, int height, double amplitude) {
  if (width < 1 || height < 1) {
    throw InputError(
        fmt::format("a map of {} × {} texels found, at least 1 × 1 expected", width, height));
  }
  if (!std::isfinite(amplitude)) {
    throw InputError(fmt::format("{} found, a finite number expected", amplitude), "amplitude");
  }
  requireMemory(static_cast<double>(width) * height * sizeof(float),
                fmt::format("a map of {} × {} texels", width, height));
}

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
