#include "render/passes/depth_pass.h"

namespace gnomon::render {

DepthPass::DepthPass(const std::filesystem::path& shaders)
    : program_(makeSurfaceProgram(shaders, {readShader(shaders / "common/nothing.frag")}, {})) {}

void DepthPass::draw(const RenderView& view, const GpuMesh& mesh, const Target& target,
                     Sides sides) const {
  target.clearDepth();
  setView(program_.name(), view);
  drawMesh(target, program_.name(), view, mesh, sides);
}

}  // namespace gnomon::render
