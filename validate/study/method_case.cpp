#include "study/method_case.h"

#include <fmt/core.h>

#include <algorithm>
#include <variant>

#include "common/error.h"
#include "render/passes.h"

namespace gnomon {
namespace {

GpuTables reliefTables(RunScene& scene, const Method& method, const BakeSpec& bake) {
  GpuTables tables;
  if (method.tables.horizon || method.tables.distance) {
    const TablePair& pair = scene.tables.tables(bake, scene.clock);
    tables.horizon = &pair.horizon;
    tables.distance = &pair.distance;
  }
  if (method.tables.angles) tables.angles = &scene.tables.angles(bake, scene.clock);
  if (method.tables.ellipse) tables.ellipse = &scene.tables.ellipses(bake, scene.clock);
  return tables;
}

}  // namespace

MethodCase prepareMethod(RunScene& scene, const MethodSpec& spec) {
  Method method = readMethod(spec.file);
  MethodPass pass(scene.shaders, method, scene.study.relief.field.wrap(), spec.filter,
                  spec.parameters);
  const GpuTables tables = reliefTables(scene, method, spec.bake);
  BaseCase& base = scene.base({method.mesh, spec.baseSubdivisions, spec.baseCurvature});
  if (method.passes.texture || method.tables.surfaceAngles) requireTextureView(base.texture);
  return {&spec, std::move(method), std::move(pass), tables, &base};
}

void requireView(const MethodCase& method, const StudySpec& study) {
  const bool isSeen = std::any_of(study.views.begin(), study.views.end(),
                                  [&](const ViewSpec& view) { return answersIn(method, view); });
  if (isSeen) return;
  throw InputError(
      fmt::format("method \"{}\" counts shadow volumes at a camera's pixels: a [[view]] of type "
                  "camera expected",
                  method.spec->label));
}

void shootTables(RunScene& scene, std::span<MethodCase> methods, const MicroMesh& mesh,
                 const MicroScene& traced) {
  for (MethodCase& method : methods) {
    if (!method.method.tables.surfaceAngles) continue;
    const RenderView& plane = method.base->texture;
    const SampleGrid texels = SamplesPass(scene.shaders).render(plane, method.base->gpu);
    const HorizonScene on{scene.surface, scene.study.relief,
                          mesh,          traced,
                          texels,        {plane.texelWindow.x, plane.texelWindow.y}};
    method.tables.angles = &scene.tables.surfaceAngles(method.spec->bake, on, scene.clock);
  }
}

bool answersIn(const MethodCase& method, const ViewSpec& view) {
  return !method.method.passes.shadowVolumes || std::holds_alternative<Camera>(view.kind);
}

Mask answerOf(const RunScene& scene, const MethodCase& method, std::size_t view,
              std::size_t light) {
  const ViewCase& seen = method.base->views[view];
  Mask mask = method.pass.render(seen.view, scene.drawing(*method.base, light), method.tables);
  const Mask& truth = seen.truths[light].mask;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (truth.samples[i] == Shade::none) mask.samples[i] = Shade::none;
  }
  return mask;
}

std::uint64_t tableBytes(const RunScene& scene, const MethodCase& method) {
  const MethodTables& declared = method.method.tables;
  const GpuTables& tables = method.tables;
  std::uint64_t bytes = 0;
  if (declared.horizon) bytes += tables.horizon->byteCount();
  if (declared.distance) bytes += tables.distance->byteCount();
  if (declared.ellipse) bytes += tables.ellipse->byteCount();
  if (tables.angles != nullptr) bytes += tables.angles->byteCount();
  return bytes + method.pass.passBytes(scene.drawing(*method.base, 0), tables);
}

}  // namespace gnomon
