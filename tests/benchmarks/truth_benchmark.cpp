// Speed of the truth on Figure 8's patch. Every case holds its baseline, measured in turn with it
// in the same process: evaluating vertex by vertex on one thread, Embree's own build, Embree's
// packets of the same rays already in order, and one light at a time.

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "figure8_patch.h"
#include "raw_rays.h"
#include "surface/texel_frame.h"
#include "truth/micro_mesh.h"
#include "truth/micro_scene.h"
#include "truth/shadow_tracer.h"

namespace {
using gnomon::Vec3;
using gnomon::benchmarks::Figure8Patch;
using gnomon::benchmarks::RawRays;
using gnomon::truth::MicroMesh;
using gnomon::truth::MicroScene;
using gnomon::truth::TraceSettings;

template <typename Work>
double secondsOf(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Times of one kind of work, of which the least is what the work takes undisturbed.
class Least {
 public:
  template <typename Work>
  void measure(const Work& work) {
    seconds_ = std::min(seconds_, secondsOf(work));
  }
  [[nodiscard]] double seconds() const { return seconds_; }

 private:
  double seconds_ = std::numeric_limits<double>::infinity();
};

gnomon::truth::MicroMeshSettings perTexel(double steps) {
  return {1 / steps, 0};
}

TraceSettings lightAt(double azimuth, double elevation) {
  return {gnomon::makeLight({azimuth, elevation})};
}

/// Vertices a second where each is evaluated on its own, from some of them, one thread.
double vertexByVertex(const Figure8Patch& patch) {
  constexpr int side = 400;
  const double seconds = secondsOf([&] {
    for (int i = 0; i < side * side; ++i) {
      const auto point =
          patch.surface.evaluate(200, i % side / double(side), i / side / double(side));
      benchmark::DoNotOptimize(gnomon::relief::displaced(
          patch.relief, gnomon::surface::texelFrame(point, patch.relief.texelsPerUv())));
    }
  });
  return side * side / seconds;
}

/// Limit surface and displacement, on one thread and on two.
void evaluation(benchmark::State& state) {
  const Figure8Patch patch;
  const auto settings = perTexel(static_cast<double>(state.range(0)));
  double vertices = 0;
  const auto build = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const MicroMesh mesh(patch.surface, patch.relief, settings);
    vertices = static_cast<double>(mesh.vertexCount());
    benchmark::DoNotOptimize(mesh.coordinates().data());
  };
  Least one, two;
  double single = 0;
  for (auto _ : state) {
    single = std::max(single, vertexByVertex(patch));
    one.measure([&] { build(1); });
    two.measure([&] { build(2); });
  }
  state.counters["vertices"] = vertices;
  state.counters["single/s"] = single;
  state.counters["one_thread/s"] = vertices / one.seconds();
  state.counters["two_threads/s"] = vertices / two.seconds();
  state.counters["two_over_one"] = one.seconds() / two.seconds();
  state.counters["over_single"] = vertices / two.seconds() / single;
}

/// A figure of /proc/self/status in bytes, as "VmHWM:".
double statusBytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  std::string word;
  double kilobytes = 0;
  while (status >> word) {
    if (word == key && status >> kilobytes) break;
  }
  return 1024 * kilobytes;
}

/// From a surface and a relief to the first ray's answer, with the process's peak memory; beside it
/// Embree's build alone.
void firstRay(benchmark::State& state) {
  const Figure8Patch patch;
  const auto settings = perTexel(static_cast<double>(state.range(0)));
  Least evaluating, building;
  double triangles = 0;
  double peak = 0;
  for (auto _ : state) {
    std::ofstream("/proc/self/clear_refs") << 5;  // the peak begins anew
    std::unique_ptr<MicroMesh> mesh;
    evaluating.measure(
        [&] { mesh = std::make_unique<MicroMesh>(patch.surface, patch.relief, settings); });
    building.measure([&] {
      const MicroScene scene(*mesh);
      benchmark::DoNotOptimize(scene.occluded(Vec3(0, 0, 0), Vec3(0, 0, 1)));
    });
    triangles = static_cast<double>(mesh->triangleCount());
    peak = statusBytes("VmHWM:");
  }
  state.counters["triangles"] = triangles;
  state.counters["seconds"] = evaluating.seconds() + building.seconds();
  state.counters["embree_s"] = building.seconds();
  state.counters["peak_bytes"] = peak;
}

/// A million shadow rays against rtcOccluded16 of the same rays.
void rays(benchmark::State& state) {
  const Figure8Patch patch;
  const MicroMesh mesh(patch.surface, patch.relief, perTexel(static_cast<double>(state.range(0))));
  const MicroScene scene(mesh);
  const auto placed = gnomon::truth::placeSamples(patch.surface, patch.relief.texelsPerUv(), mesh,
                                                  Figure8Patch::samples(46));
  const TraceSettings light = lightAt(165, 24);
  const auto truth = gnomon::truth::traceShadows(scene, placed, light);
  const RawRays raw(mesh, placed, light, truth);
  Least ours, theirs;
  std::size_t blocked = 0;
  for (auto _ : state) {
    theirs.measure([&] { blocked = raw.trace(); });
    ours.measure(
        [&] { benchmark::DoNotOptimize(gnomon::truth::traceShadows(scene, placed, light)); });
  }
  if (blocked != raw.blocked()) state.SkipWithError("both do not trace the same rays");
  const auto count = static_cast<double>(raw.count());
  state.counters["rays"] = count;
  state.counters["raw/s"] = count / theirs.seconds();
  state.counters["ours/s"] = count / ours.seconds();
  state.counters["ratio"] = theirs.seconds() / ours.seconds();
}

/// Eight lights on the same samples, together and one after the other.
void lights(benchmark::State& state) {
  const Figure8Patch patch;
  const MicroMesh mesh(patch.surface, patch.relief, perTexel(8));
  const MicroScene scene(mesh);
  const auto samples = Figure8Patch::samples(46);
  std::vector<TraceSettings> all;
  for (int l = 0; l < state.range(0); ++l) all.push_back(lightAt(165 + 45 * l, 24 + 5 * l));
  Least together, apart;
  for (auto _ : state) {
    together.measure([&] {
      benchmark::DoNotOptimize(
          gnomon::truth::traceShadows(patch.surface, patch.relief, mesh, scene, samples, all));
    });
    apart.measure([&] {
      for (const TraceSettings& light : all) {
        benchmark::DoNotOptimize(
            gnomon::truth::traceShadows(patch.surface, patch.relief, mesh, scene, samples, light));
      }
    });
  }
  const auto count = static_cast<double>(all.size());
  state.counters["samples"] = static_cast<double>(samples.samples.size());
  state.counters["together_ms_a_light"] = 1e3 * together.seconds() / count;
  state.counters["apart_ms_a_light"] = 1e3 * apart.seconds() / count;
  state.counters["ratio"] = apart.seconds() / together.seconds();
}

BENCHMARK(evaluation)
    ->ArgName("per_texel")
    ->Arg(12)
    ->Arg(24)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(3)
    ->UseRealTime();
BENCHMARK(firstRay)
    ->ArgName("per_texel")
    ->Arg(12)
    ->Arg(47)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1)
    ->UseRealTime();
BENCHMARK(rays)
    ->ArgName("per_texel")
    ->Arg(8)
    ->Arg(16)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(15)
    ->UseRealTime();
BENCHMARK(lights)
    ->ArgName("lights")
    ->Arg(1)
    ->Arg(8)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(3)
    ->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
