#include "study/run/scene/truth_stage.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "common/error.h"
#include "compare/answer_metrics.h"
#include "compare/boundaries.h"
#include "study/run/scene/cached_fields.h"
#include "study/spec/method_changes.h"
#include "truth/surface_paths.h"
#include "truth/visibility_tracer.h"

namespace gnomon::study {

namespace {

/// One a light.
std::vector<truth::TraceSettings> settingsOf(const RunScene& scene, double rayOffset) {
  std::vector<truth::TraceSettings> settings;
  for (const Light& light : scene.study.lights) {
    settings.push_back({light, rayOffset});
  }
  return settings;
}

/// The places of a view's samples, which are kept where more cases may follow; null where not.
/// @param key  of the surface
std::shared_ptr<const truth::PlacedSamples> placesOf(RunScene& scene, const TracedSurface& surface,
                                                     const cache::ContentKey& key,
                                                     const BaseCase& base, std::size_t view,
                                                     const Progress& progress) {
  const surface::SampleGrid& samples = base.views[view].samples;
  const std::uint64_t bytes =
      (sizeof(truth::RayStart) + sizeof(truth::TexelAxes)) * samples.samples.size();
  if (!scene.cache.expectsCases() || !scene.cache.canShare(bytes)) return nullptr;
  return scene.cache.share(
      cache::KeyBuilder("places")
          .add("surface", key)
          .add("samples", scene.keys.samples(base.choice, view))
          .key(),
      [&] {
        return truth::placeSamples(scene.surface, scene.study.relief.texelsPerUv(), surface.mesh,
                                   samples, progress);
      },
      bytes);
}

/// All lights, one truth each.
/// @param placed  of placesOf
std::vector<truth::Truth> trace(RunScene& scene, const TracedSurface& surface,
                                const truth::PlacedSamples* placed,
                                const surface::SampleGrid& samples,
                                std::span<const truth::TraceSettings> lights,
                                const Progress& progress) {
  if (placed == nullptr) {
    return truth::traceShadows(scene.surface, scene.study.relief, surface.mesh, surface.scene,
                               samples, lights, progress);
  }
  std::vector<truth::Truth> truths;
  for (const truth::TraceSettings& light : lights) {
    truths.push_back(truth::traceShadows(surface.scene, *placed, light, progress));
  }
  return truths;
}

void requireFrames(const surface::SampleGrid& samples, const truth::Truth& truth) {
  const auto shown =
      std::count_if(samples.samples.begin(), samples.samples.end(),
                    [](const surface::SurfaceSample& sample) { return sample.isOnSurface(); });
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

std::optional<double> differenceFromOne(std::optional<double> ratio) {
  return ratio ? std::optional(std::abs(*ratio - 1)) : std::nullopt;
}

/// One value a light: from the cache, or made for all lights together that it lacks.
/// @param make  gives the values of these lights, in their order
template <typename Value, typename KeyOf, typename Make>
std::vector<Value> rememberLights(RunScene& scene, const KeyOf& keyOf, const Make& make) {
  std::vector<std::optional<Value>> found;
  std::vector<std::size_t> missing;
  for (std::size_t l = 0; l < scene.study.lights.size(); ++l) {
    found.push_back(scene.cache.find<Value>(keyOf(l)));
    if (!found.back()) missing.push_back(l);
  }
  if (!missing.empty()) {
    std::vector<Value> made = make(missing);
    for (std::size_t i = 0; i < made.size(); ++i) {
      scene.cache.keep(keyOf(missing[i]), made[i]);
      found[missing[i]] = std::move(made[i]);
    }
  }
  std::vector<Value> values;
  values.reserve(found.size());
  for (std::optional<Value>& value : found) values.push_back(std::move(*value));
  return values;
}

/// How finely rays are traced: those of a run, or of the coarser truth that tells its uncertainty.
struct RayFineness {
  double rayOffset = truth::standardRayOffset;
  int directions;  ///< toward the discs of lights
};

RayFineness rayFineness(const StudySpec& study) {
  return {truth::standardRayOffset, study.truth.directions};
}

/// Half the offset and half the directions.
RayFineness coarserRays(const StudySpec& study) {
  return {truth::standardRayOffset / 2, study.truth.directions / 2};
}

/// Gives the truths of lights with discs their shares.
/// @param lights  of these truths, by their places in the study
void addShares(const RunScene& scene, const TracedSurface& surface,
               const surface::SampleGrid& samples, const std::vector<std::size_t>& lights,
               const RayFineness& rays, std::span<truth::Truth> truths, const Progress& progress) {
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const Light& light = scene.study.lights[lights[i]];
    if (!light.isSoft()) continue;
    truths[i].answerBy(truth::traceVisibility(surface.mesh, surface.scene, samples, truths[i].mask,
                                              {light, rays.directions, rays.rayOffset}, progress));
  }
}

std::vector<truth::TraceSettings> some(const std::vector<truth::TraceSettings>& lights,
                                       const std::vector<std::size_t>& which) {
  std::vector<truth::TraceSettings> chosen;
  chosen.reserve(which.size());
  for (const std::size_t l : which) chosen.push_back(lights[l]);
  return chosen;
}

std::shared_ptr<const truth::SurfacePaths> surfacePaths(RunScene& scene) {
  return scene.cache.share(
      surfaceKey(scene.study), [&] { return truth::SurfacePaths(scene.surface); },
      &truth::SurfacePaths::byteCount);
}

/// With all their regions. Under some of the lights, together: they share the samples' places.
std::vector<truth::Truth> traceWithRegions(RunScene& scene, const TracedSurface& surface,
                                           const BaseCase& base, std::size_t view,
                                           const std::vector<std::size_t>& which) {
  const surface::SampleGrid& samples = base.views[view].samples;
  const auto lights = some(settingsOf(scene, truth::standardRayOffset), which);
  return scene.clock.measure("truth", [&](const Progress& progress) {
    const auto placed = placesOf(scene, surface, scene.keys.surface(), base, view, progress);
    std::vector<truth::Truth> truths =
        trace(scene, surface, placed.get(), samples, lights, progress);
    const double radiusTexels = scene.study.bake.settings.radiusTexels;
    const std::vector<int> parts = scene.study.cage.limitFaceParts();
    truth::splitCastShadows(scene.surface, scene.study.relief, surface.mesh, surface.scene,
                            *surfacePaths(scene), {radiusTexels, parts}, samples, lights, truths,
                            placed.get());
    const truth::TextureCharts charts(scene.surface, scene.study.relief);
    auto crossings =
        truth::seamCrossings(scene.surface, scene.study.relief, surface.mesh, surface.scene, charts,
                             samples, truths, lights, radiusTexels);
    for (std::size_t i = 0; i < lights.size(); ++i) {
      truths[i].crossesSeam = std::move(crossings[i]);
    }
    addShares(scene, surface, samples, which, rayFineness(scene.study), truths, progress);
    return truths;
  });
}

/// The truths of one view on one mesh, one a light.
std::vector<truth::Truth> truthsOf(RunScene& scene, SurfaceOnDemand& surface, const BaseCase& base,
                                   std::size_t view) {
  const auto keyOf = [&](std::size_t light) { return scene.keys.truth(base.choice, view, light); };
  return rememberLights<truth::Truth>(scene, keyOf, [&](const std::vector<std::size_t>& missing) {
    return traceWithRegions(scene, surface.get(), base, view, missing);
  });
}

/// How a coarser truth of one view under one light differs from the run's own.
UncertaintyRecord measured(RunScene& scene, const truth::Truth& coarse, const BaseCase& base,
                           std::size_t view, std::size_t light) {
  const truth::Truth& truth = base.views[view].truths[light];
  const auto field = scene.lightField(base, view, light, scene.fieldPoints(base, view).get());
  UncertaintyRecord found{
      "", "", truth::uncertaintyOf(truth, coarse),
      differenceFromOne(castLengths(coarse.mask, truth, *field).ratio),
      compare::compareBoundaries(coarse.mask, truth.mask, base.views[view].layout)};
  found.brightening = truth::brightening(truth, coarse);
  if (!truth.isSoft()) return found;
  const truth::ShareChange change = truth::shareChange(truth.visibility, coarse.visibility);
  found.percentile99 = change.percentile99;
  found.percentile999 = change.percentile999;
  found.shares =
      sharesMetrics(coarse.visibility, truth.visibility, base.views[view].weights, *field);
  return found;
}

/// The truth's uncertainty in one view, one a light.
/// @param half, halfKey  the surface at half the resolution
std::vector<UncertaintyRecord> uncertaintiesOf(RunScene& scene, SurfaceOnDemand& half,
                                               const cache::ContentKey& halfKey,
                                               const TruthRecord& truth, const BaseCase& base,
                                               std::size_t view) {
  const auto keyOf = [&](std::size_t light) {
    return cache::KeyBuilder("uncertainty and direction")
        .add("truth", scene.keys.truth(base.choice, view, light))
        .key();
  };
  const RayFineness rays = coarserRays(scene.study);
  const auto measure = [&](const std::vector<std::size_t>& missing) {
    requireCoarser(half.get(), truth);
    return scene.clock.measure("uncertainty", [&](const Progress& progress) {
      const auto lights = some(settingsOf(scene, rays.rayOffset), missing);
      const auto placed = placesOf(scene, half.get(), halfKey, base, view, progress);
      std::vector<truth::Truth> coarse =
          trace(scene, half.get(), placed.get(), base.views[view].samples, lights, progress);
      addShares(scene, half.get(), base.views[view].samples, missing, rays, coarse, progress);
      std::vector<UncertaintyRecord> flips;
      for (std::size_t i = 0; i < coarse.size(); ++i) {
        flips.push_back(measured(scene, coarse[i], base, view, missing[i]));
      }
      return flips;
    });
  };
  return rememberLights<UncertaintyRecord>(scene, keyOf, measure);
}

}  // namespace

TracedSurface::TracedSurface(RunScene& run, const truth::MicroMeshSettings& settings,
                             std::string_view meshStage, std::string_view sceneStage)
    : mesh(run.clock.measure(meshStage,
                             [&](const Progress& progress) {
                               return withKeys("truth", [&] {
                                 return truth::MicroMesh(run.surface, run.study.relief, settings,
                                                         progress);
                               });
                             })),
      scene(run.clock.measure(sceneStage, [&](const Progress& progress) {
        return withKeys("truth", [&] { return truth::MicroScene(mesh, progress); });
      })) {}

SurfaceOnDemand::SurfaceOnDemand(Maker make) : make_(std::move(make)) {}

const TracedSurface& SurfaceOnDemand::get() {
  if (!surface_) surface_ = make_();
  return *surface_;
}

std::shared_ptr<const TracedSurface> tracedSurface(RunScene& scene, const cache::ContentKey& key,
                                                   const std::function<TracedSurface()>& make) {
  // A study alone asks for each once, and has room for one at a time.
  if (!scene.cache.expectsCases()) {
    return std::shared_ptr<const TracedSurface>(new TracedSurface(make()));
  }
  return scene.cache.share(key, make, [](const TracedSurface& surface) {
    return surface.scene.byteCount() + surface.mesh.coordinates().size_bytes();
  });
}

SurfaceOnDemand truthSurface(RunScene& scene) {
  return SurfaceOnDemand([&scene] {
    return tracedSurface(scene, scene.keys.surface(), [&scene] {
      return TracedSurface(scene, scene.study.truth.ofMesh(), "micro-mesh", "hierarchy");
    });
  });
}

TruthRecord sizesOf(RunScene& scene, SurfaceOnDemand& surface) {
  const cache::ContentKey key =
      cache::KeyBuilder("sizes").add("surface", scene.keys.surface()).key();
  return scene.cache.remember(key, [&] {
    const truth::MicroMesh& mesh = surface.get().mesh;
    TruthRecord truth;
    truth.microTriangles = mesh.triangleCount();
    truth.stepTexels = mesh.stepTexels();
    truth.askedStepTexels = mesh.askedStepTexels();
    truth.bvhBytes = surface.get().scene.byteCount();
    truth.meshBytes = mesh.coordinates().size() * sizeof(float);
    return truth;
  });
}

const BaseCase* baseWithSamples(const RunScene& scene, const BaseCase& base, std::size_t view) {
  const auto& asked = base.views[view].samples.samples;
  for (const auto& [choice, other] : scene.bases) {
    if (&other == &base) return nullptr;
    const auto& samples = other.views[view].samples.samples;
    const bool isSame =
        std::equal(samples.begin(), samples.end(), asked.begin(), asked.end(),
                   [](const surface::SurfaceSample& a, const surface::SurfaceSample& b) {
                     return a.face == b.face && a.s == b.s && a.t == b.t;
                   });
    if (isSame) return &other;
  }
  return nullptr;
}

std::uint64_t traceTruths(RunScene& scene, SurfaceOnDemand& surface) {
  std::uint64_t undefined = 0;
  for (auto& [choice, base] : scene.bases) {
    for (std::size_t v = 0; v < base.views.size(); ++v) {
      ViewCase& view = base.views[v];
      const BaseCase* same = baseWithSamples(scene, base, v);
      view.truths = same != nullptr ? same->views[v].truths : truthsOf(scene, surface, base, v);
      requireFrames(view.samples, view.truths.front());
      undefined += view.truths.front().undefinedSamples;
    }
  }
  return undefined;
}

void traceUncertainty(RunScene& scene, TruthRecord& truth,
                      const std::function<void(const TracedSurface&)>& whileTraced) {
  truth::MicroMeshSettings twice = scene.study.truth.ofMesh();
  twice.stepTexels = 2 * truth.askedStepTexels;
  const cache::ContentKey key = cache::KeyBuilder("half the resolution")
                                    .add("surface", scene.keys.surface())
                                    .add("step", truth.askedStepTexels)
                                    .key();
  SurfaceOnDemand half([&] {
    return tracedSurface(scene, key,
                         [&] { return TracedSurface(scene, twice, "uncertainty", "uncertainty"); });
  });
  const StudySpec& study = scene.study;
  for (std::size_t v = 0; v < study.views.size(); ++v) {
    std::vector<UncertaintyRecord> flips =
        uncertaintiesOf(scene, half, key, truth, scene.standardBase(), v);
    for (std::size_t l = 0; l < study.lights.size(); ++l) {
      flips[l].view = study.views[v].name;  // names are not cached
      flips[l].light = study.lights[l].name;
      truth.uncertainty = std::max(truth.uncertainty, flips[l].flipRate);
      truth.flips.push_back(std::move(flips[l]));
    }
  }
  if (whileTraced) whileTraced(half.get());
}

compare::ShadowLengths castLengths(const Mask& mask, const truth::Truth& truth,
                                   const compare::LightField& field) {
  const std::array<const Mask*, 1> one = {&mask};
  return castLengths(one, truth, field).front();
}

std::vector<compare::ShadowLengths> castLengths(std::span<const Mask* const> masks,
                                                const truth::Truth& truth,
                                                const compare::LightField& field) {
  std::vector<std::uint8_t> isCast(truth.mask.size());
  std::transform(
      truth.regions.begin(), truth.regions.end(), isCast.begin(),
      [](truth::Region region) { return static_cast<std::uint8_t>(truth::isCastShadow(region)); });
  return compare::compareShadowLengths(masks, truth.mask, field, isCast);
}

std::vector<compare::Metric> sharesMetrics(const Visibility& candidate, const Visibility& truth,
                                           std::span<const double> weights,
                                           const compare::LightField& field) {
  std::vector<compare::Metric> metrics = compare::shareMetrics(candidate, truth, weights);
  const std::vector<compare::Metric> widths =
      compare::penumbraMetrics(compare::compareShadowLengths(compare::penumbraMask(candidate),
                                                             compare::penumbraMask(truth), field));
  metrics.insert(metrics.end(), widths.begin(), widths.end());
  return metrics;
}

}  // namespace gnomon::study
