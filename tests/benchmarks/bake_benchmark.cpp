// Speed of the horizon baker, in horizons (texel × azimuth) a second, beside a plain march in
// double precision that computes the same thing to its step: the counter `ratio` of the baker's
// rows is how many times as fast it is, measured in the same process.

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <map>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "common/vec.h"
#include "relief/height_field.h"
#include "relief/horizon_bake.h"

namespace {
using gnomon::HeightField;
using gnomon::Vec2;
using gnomon::Wrap;

constexpr float amplitude = 60;

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

HeightField makeMap(const std::string& name, int size) {
  return name == "noise" ? noise(size) : hills(size);
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

/// Horizons a second of the march, one thread, from a sample of texels; measured once a map.
double marchRate(const std::string& name, int size, int radius) {
  static std::map<std::tuple<std::string, int, int>, double> known;
  const auto key = std::make_tuple(name, size, radius);
  if (const auto found = known.find(key); found != known.end()) return found->second;
  const HeightField field = makeMap(name, size);
  constexpr int samples = 20000;
  std::mt19937 random(1);
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < samples; ++i) {
    const double angle = 2 * gnomon::pi * static_cast<double>(random() % 32) / 32;
    const auto texel = [&] {
      return 0.5 + static_cast<double>(random() % static_cast<unsigned>(size));
    };
    const Vec2 p(texel(), texel());
    benchmark::DoNotOptimize(march(field, p, {std::cos(angle), std::sin(angle)}, radius));
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  return known[key] = samples / seconds.count();
}

void bake(benchmark::State& state, const std::string& name) {
  const auto size = static_cast<int>(state.range(0));
  const auto radius = static_cast<int>(state.range(1));
  const auto threads = static_cast<std::size_t>(state.range(2));
  constexpr int azimuths = 16;
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  const HeightField field = makeMap(name, size);
  const double baseline = marchRate(name, size, radius);
  std::chrono::duration<double> seconds{0};
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    const auto tables = gnomon::bakeHorizons(field, {azimuths, static_cast<double>(radius)});
    benchmark::DoNotOptimize(tables.horizon.data());
    seconds += std::chrono::steady_clock::now() - start;
  }
  const double horizons = static_cast<double>(state.iterations()) * azimuths * size * size;
  state.counters["horizons/s"] = horizons / seconds.count();
  state.counters["march/s"] = baseline;
  state.counters["ratio"] = horizons / seconds.count() / baseline;
}

BENCHMARK_CAPTURE(bake, noise, "noise")
    ->ArgNames({"size", "radius", "threads"})
    ->Args({512, 512, 1})
    ->Args({512, 512, 2})
    ->Args({512, 128, 1})
    ->Args({256, 32, 1})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(bake, hills, "hills")
    ->ArgNames({"size", "radius", "threads"})
    ->Args({512, 512, 1})
    ->Args({512, 128, 1})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
