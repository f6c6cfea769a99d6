#include "study/run/scene/run_scene.h"

#include "horizon/texel_scale.h"
#include "render/shader_files.h"

namespace gnomon {
RunScene::RunScene(const StudySpec& of, StageClock& stageClock, const GlContext& gl, Cache& kept)
    : study(of),
      clock(stageClock),
      cache(kept),
      shaders(shaderFolder()),
      keys(of, gl, shaders),
      surface(clock.measure("surface", [&](const Progress&) { return LimitSurface(of.cage); })),
      texelsPerHeight(
          gnomon::texelsPerHeight(of.relief.space, texelScale(surface, of.relief.texelsPerUv()))),
      heights(of.relief.field),
      tables(of.relief.field, texelsPerHeight, cache, keys) {}

BaseCase& RunScene::base(MeshChoice choice) {
  const auto found = bases.find(choice);
  if (found != bases.end()) return found->second;
  return clock.measure("samples", [&](const Progress&) -> BaseCase& {
    return bases.emplace(choice, makeBaseCase(study, surface, choice, shaders, cache, keys))
        .first->second;
  });
}

BaseCase& RunScene::standardBase() {
  return base(standardMesh());
}

MeshChoice RunScene::standardMesh() const {
  return {DrawnMesh::base, study.base};
}

Drawing RunScene::drawing(const BaseCase& on, std::size_t light) const {
  const DrawnBase& drawn = on.drawn.get();
  return {drawn.gpu,
          heights,
          study.relief.field.wrap(),
          study.relief.space,
          texelsPerHeight,
          study.lights[light].direction(),
          drawn.volumes ? &*drawn.volumes : nullptr,
          &drawn.texture};
}

LightField RunScene::lightField(const BaseCase& on, std::size_t view, std::size_t light) const {
  const ViewCase& seen = on.views[view];
  return makeLightField(surface, study.views[view].kind, seen.view, seen.samples,
                        study.lights[light].direction());
}

}  // namespace gnomon
