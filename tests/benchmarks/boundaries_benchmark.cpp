// Speed of the boundary metrics, in sides of contours a second, beside a search of all sides for
// the nearest: the counter `ratio` is how many times as fast all metrics are as the distances alone
// are by that search, measured in the same process.

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "common/mask.h"
#include "compare/boundaries.h"
#include "compare/contour.h"

namespace {
using gnomon::Mask;
using gnomon::Shade;
using gnomon::compare::Contour;

/// Round shadows in rows, `period` samples apart, from `shift` samples further on.
Mask discs(int size, int period, double shift) {
  Mask mask{size, size, {}};
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      const double x = std::fmod(column + 0.3 * row + shift, period) - period / 2.0;
      const double y = row % period - period / 2.0;
      mask.samples.push_back(std::hypot(x, y) < period / 3.0 ? Shade::shadowed : Shade::lit);
    }
  }
  return mask;
}

struct Place {
  double x, y;
};

std::vector<Place> placesOf(const Contour& contour) {
  std::vector<Place> places;
  for (std::size_t row = 0; row + 1 < contour.rowStarts.size(); ++row) {
    for (std::size_t i = contour.rowStarts[row]; i < contour.rowStarts[row + 1]; ++i) {
      places.push_back({contour.columns[i] / 2.0, static_cast<double>(row) / 2});
    }
  }
  return places;
}

/// Distances a second by a search of all, one thread, from a part of the sides.
double searchRate(const std::vector<Place>& from, const std::vector<Place>& to) {
  constexpr std::size_t samples = 500;
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t k = 0; k < samples; ++k) {
    const Place& place = from[k * from.size() / samples];
    double least = std::numeric_limits<double>::infinity();
    for (const Place& other : to) {
      const double dx = place.x - other.x;
      const double dy = place.y - other.y;
      least = std::min(least, dx * dx + dy * dy);
    }
    benchmark::DoNotOptimize(std::sqrt(least));
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  return static_cast<double>(samples) / seconds.count();
}

void boundaries(benchmark::State& state) {
  const auto size = static_cast<int>(state.range(0));
  const auto period = static_cast<int>(state.range(1));
  const auto threads = static_cast<std::size_t>(state.range(2));
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  const Mask candidate = discs(size, period, 1.5);
  const Mask truth = discs(size, period, 0);
  const auto ours = placesOf(gnomon::compare::contourOf(candidate, truth, {}));
  const auto theirs = placesOf(gnomon::compare::contourOf(truth, candidate, {}));
  const double search = searchRate(ours, theirs);
  std::chrono::duration<double> seconds{0};
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(gnomon::compare::compareBoundaries(candidate, truth).data());
    seconds += std::chrono::steady_clock::now() - start;
  }
  const auto sides = static_cast<double>(ours.size() + theirs.size());
  const double rate = sides * static_cast<double>(state.iterations()) / seconds.count();
  state.counters["sides"] = sides;
  state.counters["search/s"] = search;
  state.counters["ratio"] = rate / search;
}

BENCHMARK(boundaries)
    ->ArgNames({"size", "period", "threads"})
    ->Args({1024, 64, 1})
    ->Args({1024, 64, 2})
    ->Args({1024, 16, 2})
    ->Args({512, 32, 1})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
