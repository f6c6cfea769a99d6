#include "render/passes/shadow_volume_pass.h"

#include "common/error.h"

namespace gnomon::render {
namespace {

gl::Program makeVolumeProgram(const std::filesystem::path& shaders, const char* geometry) {
  return makeProgram({{readShader(shaders / "common/shadow_volume.vert")},
                      {readShader(shaders / geometry)},
                      {readShader(shaders / "common/nothing.frag")}},
                     {});
}

/// Counts what lies behind the depth: a volume's far side adds one, its near side takes one away.
void countBehind() {
  glEnable(GL_STENCIL_TEST);
  glStencilFunc(GL_ALWAYS, 0, 0xFF);
  glStencilOpSeparate(GL_FRONT, GL_KEEP, GL_DECR_WRAP, GL_KEEP);
  glStencilOpSeparate(GL_BACK, GL_KEEP, GL_INCR_WRAP, GL_KEEP);
}

}  // namespace

// Depth and volumes share the vertex stage and the way through a geometry stage: a visible triangle
// must have the very depth of the volume that it caps, or it would shade itself.
ShadowVolumePass::ShadowVolumePass(const std::filesystem::path& shaders)
    : depth_(makeVolumeProgram(shaders, "common/shadow_cap.geom")),
      volumes_(makeVolumeProgram(shaders, "common/shadow_volume.geom")) {}

void ShadowVolumePass::draw(const RenderView& view, const Drawing& drawing,
                            const Target& target) const {
  if (drawing.volumes == nullptr || view.atlasTiles.x > 0) {
    throw InternalError("shadow volumes need a displaced mesh and a camera");
  }
  target.clearDepth();
  setUniform(depth_.name(), "clipFromWorld", view.clipFromWorld);
  beginPass(target, depth_.name(), Sides::front);
  drawing.volumes->draw();

  const glm::vec4 away(-glm::vec3(drawing.light.direction), 0);
  setUniform(volumes_.name(), "clipFromWorld", view.clipFromWorld);
  setUniform(volumes_.name(), "lightDirection", drawing.light.direction);
  setUniform(volumes_.name(), "clipOfInfinity", view.clipFromWorld * away);
  beginPass(target, volumes_.name(), Sides::both);
  glDepthMask(GL_FALSE);
  glEnable(GL_DEPTH_CLAMP);  // volumes reach beyond the far plane and, maybe, the near one
  countBehind();
  drawing.volumes->draw();
  glDisable(GL_STENCIL_TEST);
  glDisable(GL_DEPTH_CLAMP);
  glDepthMask(GL_TRUE);
}

}  // namespace gnomon::render
