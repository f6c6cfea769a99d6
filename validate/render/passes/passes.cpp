#include "render/passes/passes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/gl_context.h"
#include "render/gl_objects.h"

namespace gnomon::render {
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

}  // namespace gnomon::render
