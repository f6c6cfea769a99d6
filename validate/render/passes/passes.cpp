#include "render/passes/passes.h"

#include <array>

#include "render/gl_context.h"
#include "render/gl_objects.h"

namespace gnomon::render {
namespace fs = std::filesystem;
namespace {

gl::Texture maskTexture(const Mask& mask) {
  std::vector<std::uint8_t> upward;
  upward.reserve(mask.size());
  for (int row = mask.height - 1; row >= 0; --row) {
    for (int column = 0; column < mask.width; ++column) {
      const auto i = static_cast<std::size_t>(row) * static_cast<std::size_t>(mask.width) +
                     static_cast<std::size_t>(column);
      upward.push_back(mask.samples[i] == Shade::shadowed ? 1 : 0);
    }
  }
  const gl::TextureSize size{mask.width, mask.height};
  // With linear filters an integer texture is incomplete, and reads as zero.
  gl::Texture texture = gl::makeTexture(GL_TEXTURE_2D, GL_R8UI, size, GL_NEAREST);
  gl::fill(texture, size, GL_RED_INTEGER, GL_UNSIGNED_BYTE, upward.data());
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
  const Target target(view.width, view.height, {GL_RGBA8});
  draw(view, drawing, mask, target);
  auto picture = target.read<std::uint8_t>(0, GL_RGB, GL_UNSIGNED_BYTE, 3);
  throwOnGlError("shading a picture");
  return picture;
}

void ShadePass::draw(const RenderView& view, const Drawing& drawing, const Mask& mask,
                     const Target& target) const {
  const std::array<GLfloat, 4> white = {1, 1, 1, 1};
  glClearNamedFramebufferfv(target.framebuffer(), GL_COLOR, 0, white.data());
  target.clearDepth();
  setView(program_.name(), view);
  setDrawing(program_.name(), drawing);
  const gl::Texture shadows = maskTexture(mask);
  bindTexture(program_.name(), TextureUnit::mask, shadows.name(), "shadowMask");
  drawMesh(target, program_.name(), view, drawing.mesh);
}

}  // namespace gnomon::render
