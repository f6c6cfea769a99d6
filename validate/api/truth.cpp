#include "gnomon/truth.h"

#include <fmt/core.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "api/inner/conversions.h"
#include "common/error.h"
#include "common/progress.h"
#include "horizon/angle_table.h"
#include "horizon/search_radius.h"
#include "relief/relief.h"
#include "study/spec/sections/bake_section.h"
#include "study/spec/sections/relief_section.h"
#include "study/spec/sections/view_section.h"
#include "truth/micro_mesh.h"
#include "truth/micro_scene.h"
#include "truth/shadow_tracer.h"
#include "truth/surface_paths.h"
#include "truth/visibility_tracer.h"

namespace gnomon {
inline namespace api {
namespace {

static_assert(static_cast<int>(truth::Region::beyondTerminator) ==
              static_cast<int>(ShadowRegion::beyondTerminator));
static_assert(static_cast<int>(truth::Region::global) == static_cast<int>(ShadowRegion::global));

/// The declaration of one key, which holds its range.
study::StudyKeys keyOf(const study::StudyKeys& keys, std::string_view name) {
  const auto found = std::find_if(keys.begin(), keys.end(),
                                  [&](const study::StudyKey& key) { return key.name == name; });
  return {*found};
}

relief::Relief reliefOf(const Surface::Data& surface, const Displacement& displacement) {
  study::ReliefSection section;
  study::readValues(
      toml::table{{"repeats", toml::array{displacement.repeats[0], displacement.repeats[1]}}},
      "trace", keyOf(study::keysOf(section), "repeats"));
  relief::HeightField field = heightFieldOf(displacement.map);
  const relief::Border border =
      relief::borderOf(surface.cage, surface.limit, field.wrap(), section.repeats);
  relief::Relief relief{
      std::move(field).withBorder(border),
      displacement.heightsInTexels ? relief::HeightSpace::texture : relief::HeightSpace::world,
      section.repeats};
  // Refuses what floats cannot hold.
  (void)horizon::texelScale(surface.limit, relief.texelsPerUv());
  return relief;
}

surface::SampleGrid gridOf(const SurfaceSamples& samples, int faces) {
  surface::SampleGrid grid{samples.width, samples.height, {}};
  if (samples.width < 1 || samples.height < 1 ||
      samples.places.size() !=
          static_cast<std::size_t>(samples.width) * static_cast<std::size_t>(samples.height)) {
    throw InputError(fmt::format("samples: {} places found, {} × {} expected",
                                 samples.places.size(), samples.width, samples.height));
  }
  const auto isShare = [](float value) { return value >= 0 && value <= 1; };
  grid.samples.reserve(samples.places.size());
  for (const SurfacePlace& place : samples.places) {
    if (place.face < -1 || place.face >= faces || !isShare(place.s) || !isShare(place.t)) {
      throw InputError(
          fmt::format("samples: face {}, s {}, t {} found at index {}; a face below {} and "
                      "parameters from 0 to 1 expected",
                      place.face, place.s, place.t, grid.samples.size(), faces));
    }
    grid.samples.push_back({place.face, place.s, place.t});
  }
  return grid;
}

/// Gives the lights their discs.
void addDiscs(std::vector<Light>& lights, const TraceOptions& options) {
  if (options.lightRadii.empty()) return;
  if (options.lightRadii.size() != lights.size()) {
    throw InputError(fmt::format("light radii: {} found, one for each of {} lights expected",
                                 options.lightRadii.size(), lights.size()));
  }
  study::LightSection section;
  const study::StudyKeys key = keyOf(study::keysOf(section), "radius");
  for (std::size_t i = 0; i < lights.size(); ++i) {
    study::readValues(toml::table{{"radius", options.lightRadii[i]}}, fmt::format("light {}", i),
                      key);
    lights[i].radius = radians(options.lightRadii[i]);
  }
}

std::vector<Light> lightsOf(const std::vector<std::array<double, 3>>& vectors,
                            const TraceOptions& options) {
  std::vector<Light> lights;
  for (const auto& [x, y, z] : vectors) {
    const Vec3 direction(x, y, z);
    const double length = glm::length(direction);
    if (!(length > 0 && std::isfinite(length))) {
      throw InputError(fmt::format("light {}: [{}, {}, {}] found, a direction expected",
                                   lights.size(), x, y, z));
    }
    lights.push_back({direction / length});
  }
  if (lights.empty()) throw InputError("lights: none found, at least one expected");
  addDiscs(lights, options);
  return lights;
}

/// The settings of the truth, of which the step and the directions are the caller's.
study::TruthSpec settingsOf(const TraceOptions& options) {
  study::TruthSpec settings;
  toml::table values{{"directions", options.directions}};
  if (options.step) values.insert("step", *options.step);
  study::readValues(values, "trace", study::keysOf(settings, 1));
  if (settings.directions % 2 == 0) return settings;
  throw InputError(
      fmt::format("trace: directions: {} found, an even number expected", settings.directions));
}

/// D, texels.
double radiusOf(const TraceOptions& options, const surface::LimitSurface& surface,
                const relief::Relief& relief, const std::vector<Vec3>& lights) {
  if (!options.radius) return horizon::searchRadius(surface, relief, lights).texels;
  study::BakeSpec bake;
  study::readValues(toml::table{{"radius", *options.radius}}, "trace", study::keysOf(bake, 1));
  return bake.settings.radiusTexels;
}

/// What every trace of one call shares.
struct Task {
  const surface::LimitSurface& surface;
  relief::Relief relief;
  surface::SampleGrid samples;
  std::vector<truth::TraceSettings> lights;
  int directions;
  std::optional<double> radiusTexels;  ///< D; none where no region is asked for
};

struct Traced {
  std::vector<truth::Truth> truths;
  double step = 0;  ///< that the mesh was asked for, texels
  std::uint64_t triangles = 0;
};

/// The progress of a part of some work, as that of the whole.
Progress partOf(const Progress& whole, double begin, double end) {
  return [&whole, begin, end](double share) { whole(begin + share * (end - begin)); };
}

Traced trace(const Task& task, const truth::MicroMeshSettings& settings, const Progress& progress) {
  const truth::MicroMesh mesh(task.surface, task.relief, settings, partOf(progress, 0, 0.2));
  const truth::MicroScene scene(mesh, partOf(progress, 0.2, 0.4));
  Traced traced{truth::traceShadows(task.surface, task.relief, mesh, scene, task.samples,
                                    task.lights, partOf(progress, 0.4, 0.7)),
                mesh.askedStepTexels(), mesh.triangleCount()};
  if (task.radiusTexels) {
    truth::splitCastShadows(task.surface, task.relief, mesh, scene,
                            truth::SurfacePaths(task.surface), {*task.radiusTexels}, task.samples,
                            task.lights, traced.truths);
  }
  const auto lights = static_cast<double>(task.lights.size());
  for (std::size_t i = 0; i < task.lights.size(); ++i) {
    const auto& [light, rayOffset] = task.lights[i];
    if (!light.isSoft()) continue;
    const double done = 0.7 + 0.3 * static_cast<double>(i) / lights;
    traced.truths[i].answerBy(truth::traceVisibility(
        mesh, scene, task.samples, traced.truths[i].mask, {light, task.directions, rayOffset},
        partOf(progress, done, done + 0.3 / lights)));
  }
  return traced;
}

/// The same at half the resolution and half the rays' offset, and with half the directions, as the
/// uncertainty of a run is found.
std::vector<truth::Truth> traceCoarser(Task task, const Traced& fine, const Progress& progress) {
  for (truth::TraceSettings& light : task.lights) light.rayOffset = truth::standardRayOffset / 2;
  task.directions /= 2;
  task.radiusTexels.reset();
  truth::MicroMeshSettings settings;
  settings.stepTexels = 2 * fine.step;
  Traced coarse = trace(task, settings, progress);
  if (2 * coarse.triangles > fine.triangles) {
    throw InputError(
        fmt::format(
            "{} texels found, too long to measure the truth's uncertainty; a smaller step expected",
            fine.step),
        "step");
  }
  return std::move(coarse.truths);
}

ShadowTruth shadowTruthOf(const truth::Truth& truth, const truth::Truth& coarse) {
  ShadowTruth result{
      truth.mask.width,       truth.mask.height, {}, {}, truth::uncertaintyOf(truth, coarse),
      truth.visibility.shares};
  for (const Shade shade : truth.mask.samples) {
    result.mask.push_back(byteOf(shade));
  }
  for (const truth::Region region : truth.regions) {
    result.regions.push_back(static_cast<std::uint8_t>(region));
  }
  return result;
}

}  // namespace

std::vector<ShadowTruth> traceTruth(const Surface& surface, const Displacement& displacement,
                                    const SurfaceSamples& samples,
                                    const std::vector<std::array<double, 3>>& lights,
                                    const TraceOptions& options) {
  return watched(options.progress, [&](const auto& tell) {
    const Progress progress = tell;
    const Surface::Data& data = surface.data();
    const std::vector<Light> asked = lightsOf(lights, options);
    const study::TruthSpec settings = settingsOf(options);
    Task task{data.limit, reliefOf(data, displacement), gridOf(samples, data.limit.faceCount()),
              {},         settings.directions,          {}};
    std::vector<Vec3> lowest;
    for (const Light& light : asked) {
      lowest.push_back(truth::lowestOfDisc(light));
      task.lights.push_back({light});
    }
    task.radiusTexels = radiusOf(options, data.limit, task.relief, lowest);
    const Traced fine = trace(task, settings.ofMesh(), partOf(progress, 0, 0.8));
    const std::vector<truth::Truth> coarse =
        traceCoarser(std::move(task), fine, partOf(progress, 0.8, 1));
    std::vector<ShadowTruth> truths;
    for (std::size_t i = 0; i < asked.size(); ++i) {
      truths.push_back(shadowTruthOf(fine.truths[i], coarse[i]));
    }
    return truths;
  });
}

}  // namespace api
}  // namespace gnomon
