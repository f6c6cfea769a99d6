#include "render/drawing.h"

#include <glm/gtc/type_ptr.hpp>

namespace gnomon {

gl::Program makeSurfaceProgram(const std::filesystem::path& shaders,
                               const std::vector<ShaderPiece>& fragment,
                               const std::vector<std::string>& defines) {
  return makeProgram({{readShader(shaders / "common/surface.vert")}, {}, fragment}, defines);
}

std::vector<std::string> surfaceDefines(Wrap wrap, DrawnMesh mesh) {
  std::vector<std::string> defines;
  if (wrap == Wrap::repeat) defines.emplace_back("WRAP_REPEAT");
  if (mesh == DrawnMesh::displaced) defines.emplace_back("MESH_DISPLACED");
  return defines;
}

void bindTexture(GLuint program, TextureUnit unit, GLuint texture, const char* sampler) {
  const auto index = static_cast<GLuint>(unit);
  glBindTextureUnit(index, texture);
  glProgramUniform1i(program, glGetUniformLocation(program, sampler), static_cast<GLint>(index));
}

void setUniform(GLuint program, const char* name, const Vec3& value) {
  const glm::vec3 single(value);
  glProgramUniform3fv(program, glGetUniformLocation(program, name), 1, glm::value_ptr(single));
}

void setUniform(GLuint program, const char* name, glm::vec2 value) {
  glProgramUniform2fv(program, glGetUniformLocation(program, name), 1, glm::value_ptr(value));
}

void setUniform(GLuint program, const char* name, const glm::mat4& value) {
  glProgramUniformMatrix4fv(program, glGetUniformLocation(program, name), 1, GL_FALSE,
                            glm::value_ptr(value));
}

void setView(GLuint program, const RenderView& view) {
  setUniform(program, "clipFromWorld", view.clipFromWorld);
  glProgramUniform2i(program, glGetUniformLocation(program, "atlasTiles"), view.atlasTiles.x,
                     view.atlasTiles.y);
  glProgramUniform4f(
      program, glGetUniformLocation(program, "texelWindow"),
      static_cast<GLfloat>(view.texelWindow.x), static_cast<GLfloat>(view.texelWindow.y),
      static_cast<GLfloat>(view.texelWindow.z), static_cast<GLfloat>(view.texelWindow.w));
}

void setDrawing(GLuint program, const Drawing& drawing) {
  setUniform(program, "lightDirection", drawing.light);
  glProgramUniform1i(program, glGetUniformLocation(program, "heightInTexels"),
                     drawing.heightSpace == HeightSpace::texture ? 1 : 0);
  glProgramUniform1f(program, glGetUniformLocation(program, "texelsPerHeight"),
                     static_cast<GLfloat>(drawing.texelsPerHeight));
  setUniform(program, "heightBounds", drawing.heights.bounds());
  const Border border = drawing.heights.border();
  glProgramUniform2i(program, glGetUniformLocation(program, "reliefBorder"), border.x ? 1 : 0,
                     border.y ? 1 : 0);
  bindTexture(program, TextureUnit::heights, drawing.heights.texture(), "heightMap");
}

void drawMesh(GLuint program, const RenderView& view, const GpuMesh& mesh, Sides sides) {
  glViewport(0, 0, view.width, view.height);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  if (sides == Sides::front && view.texelWindow.z == 0) {
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
  } else {
    glDisable(GL_CULL_FACE);
  }
  glUseProgram(program);
  mesh.draw();
}

}  // namespace gnomon
