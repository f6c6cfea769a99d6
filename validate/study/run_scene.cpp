#include "study/run_scene.h"

#include "render/shader_files.h"
#include "study/panel_pictures.h"

namespace gnomon {

RunScene::RunScene(const StudySpec& of, StageClock& stageClock)
    : study(of),
      clock(stageClock),
      shaders(shaderFolder()),
      surface(clock.measure("surface", [&](const Progress&) { return LimitSurface(of.cage); })),
      heights(of.relief.field),
      tables(of.relief.field) {}

BaseCase& RunScene::base(MeshChoice choice) {
  const auto found = bases.find(choice);
  if (found != bases.end()) return found->second;
  return clock.measure("samples", [&](const Progress&) -> BaseCase& {
    return bases.emplace(choice, makeBaseCase(study, surface, choice, shaders)).first->second;
  });
}

BaseCase& RunScene::standardBase() {
  return base({DrawnMesh::base, study.baseSubdivisions, study.baseCurvature});
}

Drawing RunScene::drawing(const BaseCase& on, std::size_t light) const {
  return drawingOf(study, heights, on, light);
}

LightField RunScene::lightField(const BaseCase& on, std::size_t view, std::size_t light) const {
  const ViewCase& seen = on.views[view];
  return makeLightField(surface, seen.view, seen.samples, study.lights[light].direction());
}

}  // namespace gnomon
