#include "render/shadow_volume_pass.h"

#include <glm/gtc/type_ptr.hpp>

#include "common/error.h"

namespace gnomon {
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
  target.bind();
  target.clearDepth();
  glViewport(0, 0, view.width, view.height);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  setUniform(depth_.name(), "clipFromWorld", view.clipFromWorld);
  glUseProgram(depth_.name());
  drawing.volumes->draw();

  const glm::vec4 away(-glm::vec3(drawing.light), 0);
  const glm::vec4 infinity = view.clipFromWorld * away;
  setUniform(volumes_.name(), "clipFromWorld", view.clipFromWorld);
  setUniform(volumes_.name(), "lightDirection", drawing.light);
  glProgramUniform4fv(volumes_.name(), glGetUniformLocation(volumes_.name(), "clipOfInfinity"), 1,
                      glm::value_ptr(infinity));
  glDisable(GL_CULL_FACE);
  glDepthMask(GL_FALSE);
  glEnable(GL_DEPTH_CLAMP);  // volumes reach beyond the far plane and, maybe, the near one
  countBehind();
  glUseProgram(volumes_.name());
  drawing.volumes->draw();
  glDisable(GL_STENCIL_TEST);
  glDisable(GL_DEPTH_CLAMP);
  glDepthMask(GL_TRUE);
}

}  // namespace gnomon
