#include "render/passes/light_depth_pass.h"

namespace gnomon::render {

LightDepthPass::LightDepthPass(const std::filesystem::path& shaders)
    : program_(makeSurfaceProgram(shaders, {readShader(shaders / "common/nothing.frag")}, {})) {}

void LightDepthPass::draw(const RenderView& light, const GpuMesh& mesh,
                          const Target& target) const {
  target.clearDepth();
  setView(program_.name(), light);
  drawMesh(target, program_.name(), light, mesh, Sides::both);
}

}  // namespace gnomon::render
