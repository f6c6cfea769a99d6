#include "render/passes/drawing.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/error.h"
#include "render/gl_context.h"

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

namespace fs = std::filesystem;
namespace {

/// What a mask means as light.
Visibility sharesOf(const Mask& mask) {
  Visibility shares{mask.width, mask.height, std::vector<float>(mask.size(), noSample)};
  std::transform(mask.samples.begin(), mask.samples.end(), shares.shares.begin(),
                 [](Shade shade) { return shade == Shade::shadowed ? 0.0F : 1.0F; });
  return shares;
}

gl::Texture shareTexture(const Visibility& visibility) {
  std::vector<float> upward;
  upward.reserve(visibility.size());
  for (int row = visibility.height - 1; row >= 0; --row) {
    for (int column = 0; column < visibility.width; ++column) {
      const auto i = static_cast<std::size_t>(row) * static_cast<std::size_t>(visibility.width) +
                     static_cast<std::size_t>(column);
      const float share = visibility.shares[i];
      upward.push_back(std::isnan(share) ? 1.0F : share);
    }
  }
  const gl::TextureSize size{visibility.width, visibility.height};
  gl::Texture texture = gl::makeTexture(GL_TEXTURE_2D, GL_R32F, size, GL_NEAREST);
  gl::fill(texture, size, GL_RED, GL_FLOAT, upward.data());
  return texture;
}

}  // namespace

SamplesPass::SamplesPass(const fs::path& shaders)
    : program_(makeSurfaceProgram(
          shaders,
          {readShader(shaders / "common/pixel.glsl"), readShader(shaders / "common/samples.frag")},
          {})) {}

surface::SampleGrid SamplesPass::render(const RenderView& view, const GpuMesh& mesh) const {
  const Target target(view.width, view.height, {GL_R32I, GL_RG32F});
  const std::array<GLint, 4> nothing = {-1, 0, 0, 0};
  glClearNamedFramebufferiv(target.framebuffer(), GL_COLOR, 0, nothing.data());
  target.clearDepth();
  setView(program_.name(), view);
  drawMesh(target, program_.name(), view, mesh);
  const auto faces = target.read<std::int32_t>(0, GL_RED_INTEGER, GL_INT, 1);
  const auto parameters = target.read<glm::vec2>(1, GL_RG, GL_FLOAT, 1);
  throwOnGlError("reading the samples of a view");
  surface::SampleGrid grid{view.width, view.height,
                           std::vector<surface::SurfaceSample>(faces.size())};
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (faces[i] >= 0) grid.samples[i] = {faces[i], parameters[i].x, parameters[i].y};
  }
  return grid;
}

ShadePass::ShadePass(const fs::path& shaders, relief::Wrap wrap, DrawnMesh mesh)
    : program_(makeSurfaceProgram(
          shaders,
          {readShader(shaders / "common/pixel.glsl"), readShader(shaders / "common/wrap.glsl"),
           readShader(shaders / "common/relief.glsl"), readShader(shaders / "common/shading.glsl"),
           readShader(shaders / "common/shade.frag")},
          surfaceDefines(wrap, mesh))) {}

std::vector<std::uint8_t> ShadePass::render(const RenderView& view, const Drawing& drawing,
                                            const Mask& mask) const {
  return render(view, drawing, sharesOf(mask));
}

std::vector<std::uint8_t> ShadePass::render(const RenderView& view, const Drawing& drawing,
                                            const Visibility& visibility) const {
  const Target target(view.width, view.height, {GL_RGBA8});
  draw(view, drawing, visibility, target);
  auto picture = target.read<std::uint8_t>(0, GL_RGB, GL_UNSIGNED_BYTE, 3);
  throwOnGlError("shading a picture");
  return picture;
}

void ShadePass::draw(const RenderView& view, const Drawing& drawing, const Mask& mask,
                     const Target& target) const {
  draw(view, drawing, sharesOf(mask), target);
}

void ShadePass::draw(const RenderView& view, const Drawing& drawing, const Visibility& visibility,
                     const Target& target) const {
  const std::array<GLfloat, 4> white = {1, 1, 1, 1};
  glClearNamedFramebufferfv(target.framebuffer(), GL_COLOR, 0, white.data());
  target.clearDepth();
  setView(program_.name(), view);
  setDrawing(program_.name(), drawing);
  const gl::Texture shares = shareTexture(visibility);
  bindTexture(program_.name(), TextureUnit::shares, shares.name(), "litShares");
  drawMesh(target, program_.name(), view, drawing.mesh);
}

DepthPass::DepthPass(const std::filesystem::path& shaders)
    : program_(makeSurfaceProgram(shaders, {readShader(shaders / "common/nothing.frag")}, {})) {}

void DepthPass::draw(const RenderView& view, const GpuMesh& mesh, const Target& target,
                     Sides sides) const {
  target.clearDepth();
  setView(program_.name(), view);
  drawMesh(target, program_.name(), view, mesh, sides);
}

LinePass::LinePass(const std::filesystem::path& shaders)
    : program_(makeProgram({{readShader(shaders / "common/line.vert")},
                            {},
                            {readShader(shaders / "common/line.frag")}},
                           {})) {}

void LinePass::draw(const RenderView& view, std::span<const Vec3> ends, const glm::vec3& colour,
                    const Target& target) const {
  if (ends.empty()) return;
  const std::vector<glm::vec3> vertices(ends.begin(), ends.end());
  const gl::Buffer buffer = gl::makeBuffer(std::as_bytes(std::span(vertices)));
  const std::array position = {gl::Attribute{0, 3, 0}};
  const gl::VertexArray layout = gl::makeVertexArray(buffer, sizeof(glm::vec3), position);
  setUniform(program_.name(), "clipFromWorld", view.clipFromWorld);
  setUniform(program_.name(), "lineColour", Vec3(colour));
  beginPass(target, program_.name(), Sides::both);
  glBindVertexArray(layout.name());
  glDrawArrays(GL_LINES, 0, static_cast<GLsizei>(ends.size()));
}

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
