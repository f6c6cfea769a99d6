#include "study/run/scene/truth_stage.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "common/error.h"
#include "compare/boundaries.h"
#include "study/run/scene/cached_fields.h"
#include "study/run/scene/cast_lengths.h"
#include "study/spec/with_keys.h"
#include "truth/seam_crossing.h"
#include "truth/shadow_tracer.h"

namespace gnomon {
namespace {

/// One a light.
std::vector<TraceSettings> settingsOf(const RunScene& scene, double rayOffset) {
  std::vector<TraceSettings> settings;
  for (const LightSpec& light : scene.study.lights) {
    settings.push_back({light.direction(), scene.study.bake.settings.radiusTexels, rayOffset});
  }
  return settings;
}

/// All lights, one truth each.
std::vector<Truth> trace(const RunScene& scene, const TracedSurface& surface,
                         const SampleGrid& samples, std::span<const TraceSettings> lights,
                         const Progress& progress) {
  return traceShadows(scene.surface, scene.study.relief, surface.mesh, surface.scene, samples,
                      lights, progress);
}

void requireFrames(const SampleGrid& samples, const Truth& truth) {
  const auto shown =
      std::count_if(samples.samples.begin(), samples.samples.end(),
                    [](const SurfaceSample& sample) { return sample.isOnSurface(); });
  if (truth.undefinedSamples == static_cast<std::size_t>(shown)) {
    throw InputError(
        "no sample of a view has a frame: the surface or its texture coordinates have no area");
  }
}

/// A mesh of more than half the triangles is too similar to be a second resolution.
void requireCoarser(const TracedSurface& half, const TruthRecord& truth) {
  if (2 * half.mesh.triangleCount() <= truth.microTriangles) return;
  throw InputError(fmt::format(
      "truth.step: {} texels found, but twice that gives {} micro-triangles instead of {}: too "
      "similar to measure the truth's uncertainty. A smaller step expected",
      truth.askedStepTexels, half.mesh.triangleCount(), truth.microTriangles));
}

/// What is kept of the sizes of a surface.
struct SurfaceSizes {
  std::uint64_t triangles = 0, bvhBytes = 0, meshBytes = 0;
  double stepTexels = 0, askedStepTexels = 0;
};

template <typename Stream, SameAs<SurfaceSizes> T>
void fields(Stream& stream, T& sizes) {
  stream(sizes.triangles, sizes.bvhBytes, sizes.meshBytes, sizes.stepTexels, sizes.askedStepTexels);
}

/// What is kept of the uncertainty of one view under one light.
struct Flips {
  double rate = 0;
  std::optional<double> lengthError;
  BoundaryMetrics boundaries;
};

template <typename Stream, SameAs<Flips> T>
void fields(Stream& stream, T& flips) {
  stream(flips.rate, flips.lengthError, flips.boundaries);
}

std::optional<double> differenceFromOne(std::optional<double> ratio) {
  return ratio ? std::optional(std::abs(*ratio - 1)) : std::nullopt;
}

/// What the cache has, one a light, and which lights it lacks.
template <typename Value>
struct KeptLights {
  std::vector<std::optional<Value>> values;
  std::vector<std::size_t> missing;
};

template <typename Value, typename KeyOf>
KeptLights<Value> findLights(RunScene& scene, const KeyOf& keyOf) {
  KeptLights<Value> kept;
  for (std::size_t l = 0; l < scene.study.lights.size(); ++l) {
    kept.values.push_back(scene.cache.find<Value>(keyOf(l)));
    if (!kept.values.back()) kept.missing.push_back(l);
  }
  return kept;
}

std::vector<TraceSettings> some(const std::vector<TraceSettings>& lights,
                                const std::vector<std::size_t>& which) {
  std::vector<TraceSettings> chosen;
  chosen.reserve(which.size());
  for (const std::size_t l : which) chosen.push_back(lights[l]);
  return chosen;
}

/// Under some of the lights, together: they share the samples' places.
std::vector<Truth> traceWithSeams(RunScene& scene, const TracedSurface& surface,
                                  const SampleGrid& samples,
                                  const std::vector<TraceSettings>& lights) {
  return scene.clock.measure("truth", [&](const Progress& progress) {
    std::vector<Truth> truths = trace(scene, surface, samples, lights, progress);
    const TextureCharts charts(scene.surface, scene.study.relief);
    auto crossings = seamCrossings(scene.surface, scene.study.relief, surface.mesh, surface.scene,
                                   charts, samples, truths, lights);
    for (std::size_t i = 0; i < lights.size(); ++i) {
      truths[i].crossesSeam = std::move(crossings[i]);
    }
    return truths;
  });
}

/// The truths of one view on one mesh, one a light.
std::vector<Truth> truthsOf(RunScene& scene, SurfaceOnDemand& surface, const BaseCase& base,
                            std::size_t view) {
  const auto keyOf = [&](std::size_t light) { return scene.keys.truth(base.choice, view, light); };
  KeptLights<Truth> kept = findLights<Truth>(scene, keyOf);
  if (!kept.missing.empty()) {
    std::vector<Truth> traced =
        traceWithSeams(scene, surface.get(), base.views[view].samples,
                       some(settingsOf(scene, standardRayOffset), kept.missing));
    for (std::size_t i = 0; i < traced.size(); ++i) {
      scene.cache.keep(keyOf(kept.missing[i]), traced[i]);
      kept.values[kept.missing[i]] = std::move(traced[i]);
    }
  }
  std::vector<Truth> truths;
  for (std::optional<Truth>& truth : kept.values) truths.push_back(std::move(*truth));
  return truths;
}

/// How a coarser truth of one view under one light differs from the run's own.
Flips flipsOf(RunScene& scene, const Truth& coarse, const BaseCase& base, std::size_t view,
              std::size_t light) {
  const Truth& truth = base.views[view].truths[light];
  const LightField field = scene.lightField(base, view, light);
  return {flipRate(truth.mask, coarse.mask),
          differenceFromOne(castLengths(coarse.mask, truth, field).ratio),
          {compareBoundaries(coarse.mask, truth.mask, base.views[view].layout)}};
}

/// The flips of one view, one a light.
std::vector<Flips> flipsOf(RunScene& scene, SurfaceOnDemand& half, const TruthRecord& truth,
                           const BaseCase& base, std::size_t view) {
  const auto keyOf = [&](std::size_t light) {
    return KeyBuilder("uncertainty").add("truth", scene.keys.truth(base.choice, view, light)).key();
  };
  KeptLights<Flips> kept = findLights<Flips>(scene, keyOf);
  if (!kept.missing.empty()) {
    requireCoarser(half.get(), truth);
    scene.clock.measure("uncertainty", [&](const Progress& progress) {
      const std::vector<Truth> coarse =
          trace(scene, half.get(), base.views[view].samples,
                some(settingsOf(scene, standardRayOffset / 2), kept.missing), progress);
      for (std::size_t i = 0; i < coarse.size(); ++i) {
        const std::size_t light = kept.missing[i];
        kept.values[light] = flipsOf(scene, coarse[i], base, view, light);
        scene.cache.keep(keyOf(light), *kept.values[light]);
      }
    });
  }
  std::vector<Flips> flips;
  for (std::optional<Flips>& value : kept.values) flips.push_back(std::move(*value));
  return flips;
}

}  // namespace

TracedSurface::TracedSurface(RunScene& run, const MicroMeshSettings& settings,
                             std::string_view meshStage, std::string_view sceneStage)
    : mesh(run.clock.measure(meshStage,
                             [&](const Progress& progress) {
                               return withKeys("truth", [&] {
                                 return MicroMesh(run.surface, run.study.relief, settings,
                                                  progress);
                               });
                             })),
      scene(run.clock.measure(sceneStage, [&](const Progress& progress) {
        return withKeys("truth", [&] { return MicroScene(mesh, progress); });
      })) {}

SurfaceOnDemand::SurfaceOnDemand(Maker make) : make_(std::move(make)) {}

const TracedSurface& SurfaceOnDemand::get() {
  if (!surface_) surface_ = make_();
  return *surface_;
}

TruthRecord sizesOf(RunScene& scene, SurfaceOnDemand& surface) {
  const ContentKey key = KeyBuilder("sizes").add("surface", scene.keys.surface()).key();
  const SurfaceSizes sizes = scene.cache.remember(key, [&] {
    const MicroMesh& mesh = surface.get().mesh;
    return SurfaceSizes{mesh.triangleCount(), surface.get().scene.byteCount(),
                        mesh.coordinates().size() * sizeof(float), mesh.stepTexels(),
                        mesh.askedStepTexels()};
  });
  TruthRecord truth;
  truth.microTriangles = sizes.triangles;
  truth.stepTexels = sizes.stepTexels;
  truth.askedStepTexels = sizes.askedStepTexels;
  truth.bvhBytes = sizes.bvhBytes;
  truth.meshBytes = sizes.meshBytes;
  return truth;
}

std::uint64_t traceTruths(RunScene& scene, SurfaceOnDemand& surface) {
  std::uint64_t undefined = 0;
  for (auto& [choice, base] : scene.bases) {
    for (std::size_t v = 0; v < base.views.size(); ++v) {
      ViewCase& view = base.views[v];
      view.truths = truthsOf(scene, surface, base, v);
      requireFrames(view.samples, view.truths.front());
      undefined += view.truths.front().undefinedSamples;
    }
  }
  return undefined;
}

ViewTruths traceStandardBase(RunScene& scene, const TracedSurface& surface, double rayOffset,
                             std::string_view stage) {
  const std::vector<TraceSettings> lights = settingsOf(scene, rayOffset);
  ViewTruths truths;
  for (const ViewCase& view : scene.standardBase().views) {
    truths.push_back(scene.clock.measure(stage, [&](const Progress& progress) {
      return trace(scene, surface, view.samples, lights, progress);
    }));
  }
  return truths;
}

void traceUncertainty(RunScene& scene, TruthRecord& truth) {
  MicroMeshSettings twice = scene.study.truth;
  twice.stepTexels = 2 * truth.askedStepTexels;
  SurfaceOnDemand half([&] {
    return std::make_unique<const TracedSurface>(scene, twice, "uncertainty", "uncertainty");
  });
  const StudySpec& study = scene.study;
  for (std::size_t v = 0; v < study.views.size(); ++v) {
    std::vector<Flips> flips = flipsOf(scene, half, truth, scene.standardBase(), v);
    for (std::size_t l = 0; l < study.lights.size(); ++l) {
      truth.flips.push_back({study.views[v].name, study.lights[l].name, flips[l].rate,
                             flips[l].lengthError, std::move(flips[l].boundaries.metrics)});
      truth.uncertainty = std::max(truth.uncertainty, flips[l].rate);
    }
  }
}

}  // namespace gnomon
