#include "render/passes/drawing.h"

#include <glm/gtc/type_ptr.hpp>

namespace gnomon::render {

gl::Program makeSurfaceProgram(const std::filesystem::path& shaders,
                               const std::vector<ShaderPiece>& fragment,
                               const std::vector<std::string>& defines) {
  return makeProgram({{readShader(shaders / "common/surface.vert")}, {}, fragment}, defines);
}

std::vector<std::string> surfaceDefines(relief::Wrap wrap, DrawnMesh mesh) {
  std::vector<std::string> defines;
  if (wrap == relief::Wrap::repeat) defines.emplace_back("WRAP_REPEAT");
  if (mesh == DrawnMesh::displaced) defines.emplace_back("MESH_DISPLACED");
  return defines;
}

void bindTexture(GLuint program, TextureUnit unit, GLuint texture, const char* sampler) {
  const auto index = static_cast<GLuint>(unit);
  glBindTextureUnit(index, texture);
  setUniform(program, sampler, static_cast<int>(index));
}

void setUniform(GLuint program, const char* name, int value) {
  glProgramUniform1i(program, glGetUniformLocation(program, name), value);
}

void setUniform(GLuint program, const char* name, double value) {
  glProgramUniform1f(program, glGetUniformLocation(program, name), static_cast<GLfloat>(value));
}

void setUniform(GLuint program, const char* name, glm::ivec2 value) {
  glProgramUniform2i(program, glGetUniformLocation(program, name), value.x, value.y);
}

void setUniform(GLuint program, const char* name, glm::vec2 value) {
  glProgramUniform2fv(program, glGetUniformLocation(program, name), 1, glm::value_ptr(value));
}

void setUniform(GLuint program, const char* name, const Vec3& value) {
  const glm::vec3 single(value);
  glProgramUniform3fv(program, glGetUniformLocation(program, name), 1, glm::value_ptr(single));
}

void setUniform(GLuint program, const char* name, const glm::vec4& value) {
  glProgramUniform4fv(program, glGetUniformLocation(program, name), 1, glm::value_ptr(value));
}

void setUniform(GLuint program, const char* name, const glm::mat4& value) {
  glProgramUniformMatrix4fv(program, glGetUniformLocation(program, name), 1, GL_FALSE,
                            glm::value_ptr(value));
}

void setView(GLuint program, const RenderView& view) {
  setUniform(program, "clipFromWorld", view.clipFromWorld);
  setUniform(program, "atlasTiles", view.atlasTiles);
  setUniform(program, "texelWindow", glm::vec4(view.texelWindow));
  setUniform(program, "eyePosition", Vec3(view.eye));
}

void setRelief(GLuint program, const GpuHeights& heights, relief::HeightSpace space,
               double texelsPerHeight) {
  setUniform(program, "heightInTexels", space == relief::HeightSpace::texture ? 1 : 0);
  setUniform(program, "texelsPerHeight", texelsPerHeight);
  setUniform(program, "heightBounds", heights.bounds());
  setUniform(program, "mapSize", glm::vec2(heights.size()));
  const relief::Border border = heights.border();
  setUniform(program, "reliefBorder", glm::ivec2(border.x ? 1 : 0, border.y ? 1 : 0));
  bindTexture(program, TextureUnit::heights, heights.texture(), "heightMap");
}

void setDrawing(GLuint program, const Drawing& drawing) {
  setUniform(program, "lightDirection", drawing.light.direction);
  setUniform(program, "lightRadius", drawing.light.radius);
  setUniform(program, "chartsOverlap", drawing.mesh.chartsOverlap() ? 1 : 0);
  setRelief(program, drawing.heights, drawing.heightSpace, drawing.texelsPerHeight);
}

void beginPass(const Target& target, GLuint program, Sides sides) {
  target.bind();
  glViewport(0, 0, target.width(), target.height());
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  if (sides == Sides::front) {
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
  } else {
    glDisable(GL_CULL_FACE);
  }
  glUseProgram(program);
}

void drawMesh(const Target& target, GLuint program, const RenderView& view, const GpuMesh& mesh,
              Sides sides) {
  beginPass(target, program, view.texelWindow.z == 0 ? sides : Sides::both);
  mesh.draw();
}

void drawPlane(GLuint program) {
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glUseProgram(program);
  GLuint layout = 0;
  glCreateVertexArrays(1, &layout);
  const gl::VertexArray none(layout);
  glBindVertexArray(none.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace gnomon::render
