#include "study/run/scene/run_scene.h"

#include <numeric>
#include <span>

#include "horizon/angle_table.h"
#include "render/bakes/bake_pass.h"
#include "render/passes/texel_counter.h"
#include "render/shader_files.h"
#include "study/run/scene/cached_fields.h"
#include "study/spec/method_changes.h"

namespace gnomon::study {

namespace {

double horizonBytes(const relief::HeightField& field, const horizon::BakeSettings& settings) {
  return 2 * sizeof(float) * static_cast<double>(field.texels().size()) *
         static_cast<double>(settings.azimuths);
}

}  // namespace

bool keepsHorizons(const relief::HeightField& field, const horizon::BakeSettings& settings) {
  // Beyond this, writing them takes longer than baking, and room from everything else.
  constexpr double mostBytes = 5e8;
  return horizonBytes(field, settings) <= mostBytes;
}

horizon::HorizonTables keptHorizons(cache::Cache& cache, const relief::HeightField& field,
                                    const BakeSpec& bake, const Progress& progress) {
  const auto make = [&] {
    return withKeys("bake", [&] { return horizon::bakeHorizons(field, bake.settings, progress); });
  };
  constexpr double fewBytes = 1.6e7;  // are baked as fast as they are written, in 0.05 s
  const bool isKept =
      keepsHorizons(field, bake.settings) && horizonBytes(field, bake.settings) > fewBytes;
  // The kernel gives the same bits on all instruction sets, see tests/horizon/horizon_targets_test
  // and tests/end_to_end/processors_test.
  return isKept ? cache.remember(bakeKey(field, bake), make, cache::HoldsOn::anyProcessor) : make();
}

const horizon::HorizonTables& TableSet::bake(const BakeSpec& spec, StageClock& clock) {
  std::shared_ptr<const horizon::HorizonTables>& own = bakes_[settingsKey(spec, Enters::horizons)];
  if (own) return *own;
  const auto make = [&] {
    return clock.measure("bake", [&](const Progress& progress) {
      return keptHorizons(cache_, field_, spec, progress);
    });
  };
  own = cache_.share(bakeKey(field_, spec), make, [](const horizon::HorizonTables& tables) {
    return sizeof(float) * (tables.horizon.size() + tables.distance.size());
  });
  return *own;
}

const TablePair& TableSet::tables(const BakeSpec& spec, StageClock& clock) {
  const cache::ContentKey settings = settingsKey(spec, Enters::horizons | Enters::codes);
  std::shared_ptr<const TablePair>& own = stored_[settings];
  if (own) return *own;
  const auto make = [&] {
    const horizon::HorizonTables& baked = bake(spec, clock);
    return clock.measure("tables", [&](const Progress&) {
      const auto store = [&](std::span<const float> values) {
        return render::GpuTable(horizon::storeTable(values, spec.bits), baked);
      };
      return TablePair{store(baked.horizon), store(baked.distance)};
    });
  };
  const cache::ContentKey key = cache::KeyBuilder("tables")
                                    .add("bake", bakeKey(field_, spec))
                                    .add("settings", settings)
                                    .key();
  own = cache_.share(key, make, [](const TablePair& pair) {
    return pair.horizon.byteCount() + pair.distance.byteCount();
  });
  return *own;
}

const render::GpuAngles& TableSet::angles(const BakeSpec& spec, StageClock& clock) {
  const cache::ContentKey settings =
      settingsKey(spec, Enters::horizons | Enters::codes | Enters::flatAngles);
  std::shared_ptr<const render::GpuAngles>& own = angles_[settings];
  if (own) return *own;
  const cache::ContentKey key = cache::KeyBuilder("flat angles")
                                    .add("bake", bakeKey(field_, spec))
                                    .add("settings", settings)
                                    .add("scale", texelsPerHeight_)
                                    .key();
  const auto make = [&] {
    const horizon::HorizonTables& baked = bake(spec, clock);
    return clock.measure("tables", [&](const Progress&) {
      return render::GpuAngles(horizon::horizonAngles(baked, spec.angleLimit, texelsPerHeight_),
                               spec.bits);
    });
  };
  own = cache_.share(key, make, &render::GpuAngles::byteCount);
  return *own;
}

const render::GpuAngles& TableSet::surfaceAngles(const BakeSpec& spec, const MeshChoice& mesh,
                                                 const HorizonShooter& shoot) {
  const cache::ContentKey settings = settingsKey(spec, Enters::shotAngles | Enters::codes);
  std::shared_ptr<const render::GpuAngles>& own = surfaceAngles_[{mesh, settings}];
  if (own) return *own;
  const cache::ContentKey shot = keys_.surfaceAngles(mesh, spec);
  const cache::ContentKey key =
      cache::KeyBuilder("surface angles").add("shot", shot).add("settings", settings).key();
  own = cache_.share(
      key, [&] { return render::GpuAngles(cache_.remember(shot, shoot), spec.bits); },
      &render::GpuAngles::byteCount);
  return *own;
}

const render::GpuTable& TableSet::ellipses(const BakeSpec& spec, StageClock& clock) {
  const cache::ContentKey key = settingsKey(spec, Enters::horizons | Enters::codes);
  const auto found = ellipses_.find(key);
  if (found != ellipses_.end()) return found->second;
  const horizon::HorizonTables& baked = bake(spec, clock);
  return clock.measure("tables", [&](const Progress&) -> const render::GpuTable& {
    const horizon::EllipseTable fitted =
        cache_.remember(keys_.ellipses(spec, texelsPerHeight_),
                        [&] { return horizon::fitEllipses(baked, texelsPerHeight_); });
    return ellipses_.try_emplace(key, horizon::storeTable(fitted.values, spec.bits), fitted)
        .first->second;
  });
}

namespace {

std::shared_ptr<const surface::LimitSurface> limitSurface(const StudySpec& study,
                                                          cache::Cache& cache) {
  return cache.share(
      surfaceKey(study), [&] { return surface::LimitSurface(study.cage); },
      [](const surface::LimitSurface& surface) {
        constexpr std::uint64_t bytesPerFace = 1000;  // about
        return bytesPerFace * static_cast<std::uint64_t>(surface.faceCount());
      });
}

std::shared_ptr<const surface::TextureLayout> textureLayout(const StudySpec& study,
                                                            const surface::LimitSurface& surface,
                                                            cache::Cache& cache) {
  return cache.share(
      surfaceKey(study), [&] { return surface::textureLayout(surface); },
      [](const surface::TextureLayout& layout) { return sizeof(int) * layout.charts.size(); });
}

}  // namespace

RunScene::RunScene(const StudySpec& of, StageClock& stageClock, const render::GlContext& gl,
                   cache::Cache& kept)
    : study(of),
      clock(stageClock),
      cache(kept),
      shaders(render::shaderFolder()),
      keys(of, gl, shaders),
      ownedSurface(
          clock.measure("surface", [&](const Progress&) { return limitSurface(of, cache); })),
      surface(*ownedSurface),
      layout(clock.measure("surface",
                           [&](const Progress&) { return textureLayout(of, surface, cache); })),
      texelsPerHeight(horizon::texelsPerHeight(
          of.relief.space, horizon::texelScale(surface, of.relief.texelsPerUv()))),
      heights(of.relief.field),
      tables(of.relief.field, texelsPerHeight, cache, keys) {}

BaseCase& RunScene::base(MeshChoice choice) {
  const auto found = bases.find(choice);
  if (found != bases.end()) return found->second;
  return clock.measure("samples", [&](const Progress&) -> BaseCase& {
    return bases
        .emplace(choice, makeBaseCase(study, surface, choice, {shaders, cache, keys, *layout}))
        .first->second;
  });
}

const DrawnBase& RunScene::mesh(MeshChoice choice) {
  const auto base = bases.find(choice);
  if (base != bases.end()) return *base->second.drawn.get();
  auto found = lightMeshes.find(choice);
  if (found == lightMeshes.end()) {
    auto made = drawnOnDemand(study, surface, choice, {shaders, cache, keys, *layout});
    found = lightMeshes.emplace(choice, std::move(made)).first;
  }
  return clock.measure("samples",
                       [&](const Progress&) -> const DrawnBase& { return *found->second.get(); });
}

BaseCase& RunScene::standardBase() {
  return base(standardMesh());
}

MeshChoice RunScene::standardMesh() const {
  return {render::DrawnMesh::base, study.base};
}

render::Drawing RunScene::drawing(const BaseCase& on, std::size_t light) const {
  const DrawnBase& drawn = *on.drawn.get();
  return {drawn.gpu,
          heights,
          study.relief.field.wrap(),
          study.relief.space,
          texelsPerHeight,
          study.lights[light],
          drawn.volumes ? &*drawn.volumes : nullptr,
          &drawn.texture};
}

std::shared_ptr<const FieldPoints> RunScene::fieldPoints(const BaseCase& on,
                                                         std::size_t view) const {
  const surface::SampleGrid& samples = on.views[view].samples;
  const std::uint64_t bytes = sizeof(FieldPoint) * samples.samples.size();
  if (!cache.canShare(bytes)) return nullptr;
  return cache.share(
      keys.samples(on.choice, view),
      [&] {
        return makeFieldPoints(surface, study.views[view].kind, on.views[view].view, samples);
      },
      bytes);
}

std::shared_ptr<const compare::LightField> RunScene::lightField(const BaseCase& on,
                                                                std::size_t view, std::size_t light,
                                                                const FieldPoints* points) {
  if (last_.base == &on && last_.view == view && last_.light == light) return last_.field;
  last_ = {};  // its memory goes before the next one's comes
  const ViewCase& seen = on.views[view];
  const ViewKind& kind = study.views[view].kind;
  const Vec3 toLight = study.lights[light].direction;
  compare::LightField made =
      points == nullptr ? makeLightField(surface, kind, seen.view, seen.samples, toLight)
                        : makeLightField(surface, kind, seen.view, seen.samples, *points, toLight);
  last_ = {&on, view, light, std::make_shared<const compare::LightField>(std::move(made))};
  return last_.field;
}

SampleBins RunScene::bins(const BaseCase& on, std::size_t view, std::size_t light) const {
  const surface::SampleGrid& samples = on.views[view].samples;
  const Vec3 toLight = study.lights[light].direction;
  const std::uint64_t bytes = sizeof(AxisPlace) * samples.samples.size();
  const bool isShared = cache.canShare(bytes);
  const auto fromPlaces = [&] {
    const auto places = cache.share(
        keys.samples(on.choice, view), [&] { return axisPlaces(surface, study.relief, samples); },
        bytes);
    return binSamples(samples, *places, toLight);
  };
  // With the places of the case before it takes less than to keep them.
  if (isShared && cache.expectsCases()) return fromPlaces();
  return cache.remember(keys.bins(on.choice, view, light), [&] {
    return isShared && study.lights.size() > 1
               ? fromPlaces()
               : binSamples(surface, study.relief, samples, toLight);
  });
}

namespace {

std::uint64_t bytesOfAll(const std::vector<render::GpuBake>& bakes) {
  return std::accumulate(
      bakes.begin(), bakes.end(), std::uint64_t{0},
      [](std::uint64_t sum, const auto& bake) { return sum + bake.byteCount(); });
}

/// Whether bakes are small enough to be kept on disk.
bool areKept(const render::Method& method, glm::ivec2 map) {
  constexpr double mostBytes = 5e8;
  double bytes = 0;
  for (const render::MethodBake& bake : method.bakes) {
    bytes += static_cast<double>(render::bytesOver(bake, map));
  }
  return bytes <= mostBytes;
}

/// The functions that bake, compiled once for all cases.
std::shared_ptr<const render::BakePass> compiledPass(RunScene& scene, const MethodSpec& spec,
                                                     const render::Method& method) {
  return scene.cache.share(
      scene.keys.program(spec, method),
      [&] {
        return render::BakePass(scene.shaders, method, scene.study.relief.field.wrap(), spec.filter,
                                spec.parameters, !isBuiltIn(spec) && render::hasLoops(method));
      },
      programBytes);
}

}  // namespace

std::shared_ptr<const std::vector<render::GpuBake>> methodBakes(RunScene& scene,
                                                                const MethodSpec& spec,
                                                                const render::Method& method,
                                                                const render::GpuTables& tables) {
  if (method.bakes.empty()) return nullptr;
  render::requireBakeSizes(method, scene.heights.size());
  const relief::Relief& relief = scene.study.relief;
  const render::BakeScene from{scene.heights, relief.field.wrap(), relief.space,
                               scene.texelsPerHeight};
  return scene.clock.measure("bake", [&](const Progress& progress) {
    const auto pass = compiledPass(scene, spec, method);
    const cache::ContentKey key =
        scene.keys.methodBakes(spec, method, pass->parameters(), scene.texelsPerHeight);
    const auto bake = [&] { return pass->bake(from, tables, progress); };
    return scene.cache.share(
        key,
        [&] {
          const auto stored =
              areKept(method, scene.heights.size()) ? scene.cache.remember(key, bake) : bake();
          return render::gpuBakes(method, stored, from);
        },
        bytesOfAll);
  });
}

}  // namespace gnomon::study
