#include "study/run/scene/run_scene.h"

#include "horizon/texel_scale.h"
#include "render/shader_files.h"

namespace gnomon::study {
namespace {

std::shared_ptr<const surface::LimitSurface> limitSurface(const StudySpec& study,
                                                          SceneStore& store) {
  const auto bytes = [&](const surface::LimitSurface& surface) {
    constexpr std::uint64_t bytesPerFace = 1000;  // about
    return bytesPerFace * static_cast<std::uint64_t>(surface.faceCount());
  };
  return store.get<surface::LimitSurface>(
      surfaceKey(study), [&] { return std::make_shared<const surface::LimitSurface>(study.cage); },
      bytes);
}

std::shared_ptr<const surface::TextureLayout> textureLayout(const StudySpec& study,
                                                            const surface::LimitSurface& surface,
                                                            SceneStore& store) {
  return store.get<surface::TextureLayout>(
      surfaceKey(study),
      [&] {
        return std::make_shared<const surface::TextureLayout>(surface::textureLayout(surface));
      },
      [](const surface::TextureLayout& layout) { return sizeof(int) * layout.charts.size(); });
}

}  // namespace

RunScene::RunScene(const StudySpec& of, StageClock& stageClock, const render::GlContext& gl,
                   cache::Cache& kept, SceneStore& held)
    : study(of),
      clock(stageClock),
      cache(kept),
      store(held),
      shaders(render::shaderFolder()),
      keys(of, gl, shaders),
      heldSurface(
          clock.measure("surface", [&](const Progress&) { return limitSurface(of, store); })),
      surface(*heldSurface),
      layout(clock.measure("surface",
                           [&](const Progress&) { return textureLayout(of, surface, store); })),
      texelsPerHeight(horizon::texelsPerHeight(
          of.relief.space, horizon::texelScale(surface, of.relief.texelsPerUv()))),
      heights(of.relief.field),
      tables(of.relief.field, texelsPerHeight, cache, store, keys) {}

BaseCase& RunScene::base(MeshChoice choice) {
  const auto found = bases.find(choice);
  if (found != bases.end()) return found->second;
  return clock.measure("samples", [&](const Progress&) -> BaseCase& {
    return bases
        .emplace(choice,
                 makeBaseCase(study, surface, choice, {shaders, cache, store, keys, *layout}))
        .first->second;
  });
}

const DrawnBase& RunScene::mesh(MeshChoice choice) {
  const auto base = bases.find(choice);
  if (base != bases.end()) return *base->second.drawn.get();
  auto found = lightMeshes.find(choice);
  if (found == lightMeshes.end()) {
    auto made = drawnOnDemand(study, surface, choice, {shaders, cache, store, keys, *layout});
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
  if (!store.canHold(bytes)) return nullptr;
  return store.get<FieldPoints>(
      keys.samples(on.choice, view),
      [&] {
        return std::make_shared<const FieldPoints>(
            makeFieldPoints(surface, study.views[view].kind, on.views[view].view, samples));
      },
      [&](const FieldPoints&) { return bytes; });
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
  const bool isHeld = store.canHold(bytes);
  const auto fromPlaces = [&] {
    const auto places = store.get<AxisPlaces>(
        keys.samples(on.choice, view),
        [&] {
          return std::make_shared<const AxisPlaces>(axisPlaces(surface, study.relief, samples));
        },
        [&](const AxisPlaces&) { return bytes; });
    return binSamples(samples, *places, toLight);
  };
  // With the places of the case before it takes less than to keep them.
  if (isHeld && store.expectsCases()) return fromPlaces();
  return cache.remember(keys.bins(on.choice, view, light), [&] {
    return isHeld && study.lights.size() > 1 ? fromPlaces()
                                             : binSamples(surface, study.relief, samples, toLight);
  });
}

}  // namespace gnomon::study
