// Speed of the horizon baker, in horizons (texel × azimuth) a second. `horizons/s` is by the clock,
// all threads; `horizons/s/core` the best run by processor time. Beside it, measured in the same
// process on one core, two others.
//
// The march is a plain one in double precision that computes the same thing to its step; `ratio` is
// how many times as fast a core of the baker is.
//
// The hull sweep (hull_sweep.h) is the fastest known way, and not exact: `hull_off` and
// `hull_worst` say by how many degrees its horizons differ from the baker's, on average and at
// worst; `to_hull` is the speed of a core of the baker over its.

#include <benchmark/benchmark.h>
#include <hwy/targets.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "common/vec.h"
#include "horizon/horizon_bake.h"
#include "horizon/kernel/tile_kernel.h"
#include "horizon/reference.h"
#include "hull_sweep.h"
#include "relief/height_field.h"

namespace {
using gnomon::Vec2;
using gnomon::benchmarks::HullHorizons;
using gnomon::relief::HeightField;
using gnomon::relief::Wrap;

constexpr float amplitude = 60;  // texels
constexpr int azimuths = 32;

/// Uncorrelated heights: nothing to skip but what the bounds give.
HeightField noise(int size) {
  std::mt19937 random(7);
  std::vector<float> texels(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  for (float& h : texels) h = amplitude * static_cast<float>(random()) * 0x1p-32F;
  return {size, size, std::move(texels), Wrap::repeat};
}

/// Smooth hills a quarter of the map wide.
HeightField hills(int size) {
  std::vector<float> texels;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double phase = 8 * gnomon::pi / size;
      texels.push_back(static_cast<float>(amplitude * std::sin(phase * x) * std::cos(phase * y)));
    }
  }
  return {size, size, std::move(texels), Wrap::repeat};
}

/// In place: a_j becomes the sum of a_k exp(2πi jk / n), n a power of two.
void transform(std::vector<std::complex<double>>& a) {
  const std::size_t n = a.size();
  if (n == 1) return;
  std::vector<std::complex<double>> even(n / 2), odd(n / 2);
  for (std::size_t i = 0; i < n / 2; ++i) {
    even[i] = a[2 * i];
    odd[i] = a[2 * i + 1];
  }
  transform(even);
  transform(odd);
  for (std::size_t k = 0; k < n / 2; ++k) {
    const double angle = 2 * gnomon::pi * static_cast<double>(k) / static_cast<double>(n);
    const std::complex<double> turned = std::polar(1.0, angle) * odd[k];
    a[k] = even[k] + turned;
    a[k + n / 2] = even[k] - turned;
  }
}

/// Terrain that repeats: waves of random phase, their amplitudes the frequency to the power
/// -exponent, from 0 to `amplitude` high. Power spectra as f⁻³ (exponent 1.5) are rough, as f⁻⁴
/// (exponent 2) smooth.
HeightField terrain(int size, double exponent) {
  const auto n = static_cast<std::size_t>(size);
  std::mt19937 random(7);
  std::vector<std::vector<std::complex<double>>> waves(n, std::vector<std::complex<double>>(n));
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double f = std::hypot(x <= size / 2 ? x : x - size, y <= size / 2 ? y : y - size);
      const double phase = 2 * gnomon::pi * static_cast<double>(random()) * 0x1p-32;
      if (f > 0)
        waves[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] =
            std::polar(std::pow(f, -exponent), phase);
    }
  }
  for (auto& row : waves) transform(row);
  for (std::size_t x = 0; x < n; ++x) {
    std::vector<std::complex<double>> column(n);
    for (std::size_t y = 0; y < n; ++y) column[y] = waves[y][x];
    transform(column);
    for (std::size_t y = 0; y < n; ++y) waves[y][x] = column[y];
  }
  double low = 0;
  double high = 0;
  for (const auto& row : waves) {
    for (const auto& wave : row) {
      low = std::min(low, wave.real());
      high = std::max(high, wave.real());
    }
  }
  std::vector<float> texels;
  for (const auto& row : waves) {
    for (const auto& wave : row) {
      texels.push_back(amplitude * static_cast<float>((wave.real() - low) / (high - low)));
    }
  }
  return {size, size, std::move(texels), Wrap::repeat};
}

enum class Map { smooth, rough, noise, hills };

HeightField makeMap(Map map, int size) {
  switch (map) {
    case Map::smooth:
      return terrain(size, 2);
    case Map::rough:
      return terrain(size, 1.5);
    case Map::noise:
      return noise(size);
    default:
      return hills(size);
  }
}

/// The horizon by unit steps of the bilinear function, up to where the map's highest texel could no
/// longer raise it.
double march(const HeightField& field, Vec2 p, Vec2 e, double radius) {
  const double h0 = field.at(p);
  const double most = field.maximum() - h0;
  double best = -1e30;
  for (double r = 1; r <= radius && most > best * r; r += 1) {
    best = std::max(best, (field.at(p + r * e) - h0) / r);
  }
  return best;
}

/// Of all threads together: what the rest of the machine does disturbs it less than the clock.
double processorSeconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Horizons a second of the march, one thread, from a sample of texels.
double marchRate(const HeightField& field, int radius) {
  constexpr int samples = 4000;
  const int size = field.width();
  std::mt19937 random(1);
  const double start = processorSeconds();
  for (int i = 0; i < samples; ++i) {
    const double angle = 2 * gnomon::pi * static_cast<double>(random() % azimuths) / azimuths;
    const auto texel = [&] {
      return 0.5 + static_cast<double>(random() % static_cast<unsigned>(size));
    };
    const Vec2 p(texel(), texel());
    benchmark::DoNotOptimize(march(field, p, {std::cos(angle), std::sin(angle)}, radius));
  }
  return samples / (processorSeconds() - start);
}

/// What the hull sweep makes of a map.
struct HullResult {
  double rate = 0;                           ///< horizons a second
  double meanDegrees = 0, worstDegrees = 0;  ///< off the baker's, as angles
};

/// The best of several sweeps.
/// @param swept  what they find
double sweepSeconds(const HeightField& field, Vec2 direction, HullHorizons& swept) {
  constexpr int repeats = 5;
  double best = 1e30;
  for (int i = 0; i < repeats; ++i) {
    const double start = processorSeconds();
    swept = gnomon::benchmarks::sweepHulls(field, direction);
    best = std::min(best, processorSeconds() - start);
  }
  return best;
}

/// One thread, the azimuths of the first octant.
HullResult hullResult(const HeightField& field, const gnomon::horizon::HorizonTables& exact) {
  constexpr int count = azimuths / 8 + 1;
  const std::size_t texels = field.texels().size();
  const double horizons = static_cast<double>(texels) * count;
  HullResult result;
  double seconds = 0;
  for (int m = 0; m < count; ++m) {
    HullHorizons swept;
    seconds += sweepSeconds(field, gnomon::horizon::azimuthDirection(m, azimuths), swept);
    for (std::size_t i = 0; i < texels; ++i) {
      const float truth = exact.horizon[static_cast<std::size_t>(m) * texels + i];
      const double off = std::abs(std::atan(swept.slope[i]) - std::atan(truth)) * 180 / gnomon::pi;
      result.meanDegrees += off / horizons;
      result.worstDegrees = std::max(result.worstDegrees, off);
    }
  }
  result.rate = horizons / seconds;
  return result;
}

/// What is baked; `target` is one of Google Highway's, 0 for the best of this processor.
struct BakeCase {
  Map map;
  int size;
  int radius;
  std::size_t threads = 1;
  std::int64_t target = 0;
};

void measure(benchmark::State& state, const BakeCase& c, const std::function<void()>& bake) {
  const double horizons = static_cast<double>(azimuths) * c.size * c.size;
  for (auto _ : state) bake();
  using benchmark::Counter;
  state.counters["horizons/s"] = Counter(horizons, Counter::kIsIterationInvariantRate);
  state.counters["size"] = c.size;
  state.counters["radius"] = c.radius;
  state.counters["threads"] = static_cast<double>(c.threads);
}

void bake(benchmark::State& state, const BakeCase& c) {
  hwy::SetSupportedTargetsForTest(c.target);
  state.SetLabel(gnomon::horizon::bakeInstructionSet());
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, c.threads);
  const HeightField field = makeMap(c.map, c.size);
  double best = 1e30;
  gnomon::horizon::HorizonTables tables;
  measure(state, c, [&] {
    tables = {};
    const double start = processorSeconds();
    tables = gnomon::horizon::bakeHorizons(field, {azimuths, static_cast<double>(c.radius)});
    best = std::min(best, processorSeconds() - start);
  });
  hwy::SetSupportedTargetsForTest(0);
  const double rate = static_cast<double>(azimuths) * c.size * c.size / best;
  const double baseline = marchRate(field, c.radius);
  state.counters["horizons/s/core"] = rate;
  state.counters["march/s"] = baseline;
  state.counters["ratio"] = rate / baseline;
  // The hull sweep sees as far as the map is wide. A table of CSV has the same columns in every
  // row.
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const HullResult hull =
      c.radius < c.size ? HullResult{none, none, none} : hullResult(field, tables);
  state.counters["hull/s"] = hull.rate;
  state.counters["to_hull"] = rate / hull.rate;
  state.counters["hull_off"] = hull.meanDegrees;
  state.counters["hull_worst"] = hull.worstDegrees;
}

/// Straight to 8-bit tables, without the floats.
void bakeStored(benchmark::State& state, const BakeCase& c) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, c.threads);
  const HeightField field = makeMap(c.map, c.size);
  measure(state, c, [&] {
    const auto tables = gnomon::horizon::bakeStoredHorizons(
        field, {azimuths, static_cast<double>(c.radius)}, gnomon::horizon::TableBits::eight);
    benchmark::DoNotOptimize(tables.horizon.bytes.data());
  });
}

void registerCase(const std::string& name, void (*run)(benchmark::State&, const BakeCase&),
                  const BakeCase& c) {
  benchmark::RegisterBenchmark(name.c_str(), run, c)->Unit(benchmark::kMillisecond)->UseRealTime();
}

void registerCases() {
  const std::map<std::string, Map> maps{
      {"smooth", Map::smooth}, {"rough", Map::rough}, {"noise", Map::noise}, {"hills", Map::hills}};
  for (const auto& [name, map] : maps) registerCase("map/" + name, bake, {map, 512, 512});
  for (const std::size_t threads : {1U, 2U}) {
    registerCase("threads/" + std::to_string(threads), bake, {Map::smooth, 512, 512, threads});
  }
  for (const std::int64_t target :
       std::array<std::int64_t, 4>{HWY_EMU128, HWY_SSE4, HWY_AVX2, HWY_AVX3}) {
    if ((hwy::SupportedTargets() & target) == 0) continue;
    registerCase(std::string("target/") + hwy::TargetName(target), bake,
                 {Map::smooth, 512, 512, 1, target});
  }
  for (int radius = 8; radius <= 4096; radius *= 2) {
    registerCase("radius/" + std::to_string(radius), bake, {Map::smooth, 512, radius});
  }
  for (int size = 128; size <= 2048; size *= 2) {
    registerCase("size/" + std::to_string(size), bake, {Map::smooth, size, 128});
  }
  registerCase("stored", bakeStored, {Map::smooth, 512, 512});
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  registerCases();
  benchmark::RunSpecifiedBenchmarks();
}
