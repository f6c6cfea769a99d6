#include "study/truth_stage.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "common/error.h"
#include "compare/boundaries.h"
#include "study/cast_lengths.h"
#include "truth/seam_crossing.h"
#include "truth/shadow_tracer.h"

namespace gnomon {
namespace {

/// One a light.
std::vector<TraceSettings> settingsOf(const RunScene& scene, double liftShare) {
  std::vector<TraceSettings> settings;
  for (const LightSpec& light : scene.study.lights) {
    settings.push_back({light.direction(), scene.study.bake.settings.radiusTexels, liftShare});
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
  const auto shown = std::count_if(samples.samples.begin(), samples.samples.end(),
                                   [](const SurfaceSample& sample) { return sample.face >= 0; });
  if (truth.undefinedSamples == static_cast<std::size_t>(shown)) {
    throw InputError(
        "no sample of a view has a frame: the surface or its texture coordinates have no area");
  }
}

/// Less than a half's worth of triangles is no second resolution.
void requireCoarser(const TracedSurface& half, const TruthRecord& truth) {
  if (2 * half.mesh.triangleCount() <= truth.microTriangles) return;
  throw InputError(fmt::format(
      "truth.step: {} texels found, but twice that gives {} micro-triangles instead of {}: too "
      "alike to tell the truth's own error. A smaller step expected",
      truth.stepTexels, half.mesh.triangleCount(), truth.microTriangles));
}

std::optional<double> differenceFromOne(std::optional<double> ratio) {
  return ratio ? std::optional(std::abs(*ratio - 1)) : std::nullopt;
}

}  // namespace

TracedSurface::TracedSurface(RunScene& run, const MicroMeshSettings& settings,
                             std::string_view meshStage, std::string_view sceneStage)
    : mesh(run.clock.measure(meshStage,
                             [&](const Progress& progress) {
                               return MicroMesh(run.surface, run.study.relief, settings, progress);
                             })),
      scene(run.clock.measure(
          sceneStage, [&](const Progress& progress) { return MicroScene(mesh, progress); })) {}

TruthRecord sizesOf(const TracedSurface& surface) {
  TruthRecord truth;
  truth.microTriangles = surface.mesh.triangleCount();
  truth.stepTexels = surface.mesh.stepTexels();
  truth.bvhBytes = surface.scene.byteCount();
  truth.meshBytes = surface.mesh.coordinates().size() * sizeof(float);
  return truth;
}

std::uint64_t traceTruths(RunScene& scene, const TracedSurface& surface) {
  std::uint64_t undefined = 0;
  const TextureCharts charts(scene.surface, scene.study.relief);
  const std::vector<TraceSettings> lights = settingsOf(scene, standardLift);
  for (auto& [choice, base] : scene.bases) {
    for (ViewCase& view : base.views) {
      view.truths = scene.clock.measure("truth", [&](const Progress& progress) {
        return trace(scene, surface, view.samples, lights, progress);
      });
      scene.clock.measure("truth", [&](const Progress&) {
        auto crossings = seamCrossings(scene.surface, scene.study.relief, surface.mesh,
                                       surface.scene, charts, view.samples, view.truths, lights);
        for (std::size_t l = 0; l < lights.size(); ++l) {
          view.truths[l].crossesSeam = std::move(crossings[l]);
        }
      });
      requireFrames(view.samples, view.truths.front());
      undefined += view.truths.front().undefinedSamples;
    }
  }
  return undefined;
}

ViewTruths traceStandardBase(RunScene& scene, const TracedSurface& surface, double liftShare,
                             std::string_view stage) {
  const std::vector<TraceSettings> lights = settingsOf(scene, liftShare);
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
  twice.stepTexels = 2 * truth.stepTexels;
  const TracedSurface half(scene, twice, "uncertainty", "uncertainty");
  requireCoarser(half, truth);
  const StudySpec& study = scene.study;
  const BaseCase& base = scene.standardBase();
  const ViewTruths coarser = traceStandardBase(scene, half, standardLift / 2, "uncertainty");
  for (std::size_t v = 0; v < study.views.size(); ++v) {
    const ViewCase& view = base.views[v];
    for (std::size_t l = 0; l < study.lights.size(); ++l) {
      const Truth& coarse = coarser[v][l];
      const double flips = flipRate(view.truths[l].mask, coarse.mask);
      const auto lengthError = scene.clock.measure("uncertainty", [&](const Progress&) {
        const LightField field = scene.lightField(base, v, l);
        return differenceFromOne(castLengths(coarse.mask, view.truths[l], field).ratio);
      });
      auto boundaries = scene.clock.measure("uncertainty", [&](const Progress&) {
        return compareBoundaries(coarse.mask, view.truths[l].mask, view.layout);
      });
      truth.flips.push_back(
          {study.views[v].name, study.lights[l].name, flips, lengthError, std::move(boundaries)});
      truth.uncertainty = std::max(truth.uncertainty, flips);
    }
  }
}

}  // namespace gnomon
