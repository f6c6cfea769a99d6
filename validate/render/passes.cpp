#include "render/passes.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <glm/gtc/type_ptr.hpp>

#include "common/error.h"
#include "render/gl_context.h"
#include "render/program.h"
#include "render/target.h"

namespace gnomon {
namespace fs = std::filesystem;
namespace {

/// The texture units that the passes use.
constexpr GLuint heightUnit = 0;
constexpr GLuint horizonUnit = 1;
constexpr GLuint distanceUnit = 2;
constexpr GLuint maskUnit = 3;

std::vector<std::string> reliefDefines(Wrap wrap, bool heights) {
  std::vector<std::string> defines;
  if (wrap == Wrap::repeat) defines.emplace_back("WRAP_REPEAT");
  if (heights) defines.emplace_back("TABLE_HEIGHT");
  return defines;
}

gl::Program makePass(const fs::path& shaders, const std::vector<ShaderPiece>& fragment,
                     const std::vector<std::string>& defines) {
  return makeProgram({readShader(shaders / "common/surface.vert")}, fragment, defines);
}

void setUniform(GLuint program, const char* name, const Vec3& value) {
  const glm::vec3 single(value);
  glProgramUniform3fv(program, glGetUniformLocation(program, name), 1, glm::value_ptr(single));
}

void setView(GLuint program, const RenderView& view) {
  glProgramUniformMatrix4fv(program, glGetUniformLocation(program, "clipFromWorld"), 1, GL_FALSE,
                            glm::value_ptr(view.clipFromWorld));
  glProgramUniform2i(program, glGetUniformLocation(program, "atlasTiles"), view.atlasTiles.x,
                     view.atlasTiles.y);
}

void setDrawing(GLuint program, const Drawing& drawing) {
  setUniform(program, "lightDirection", drawing.light);
  glProgramUniform1i(program, glGetUniformLocation(program, "heightInTexels"),
                     drawing.heightSpace == HeightSpace::texture ? 1 : 0);
  glProgramUniform1i(program, glGetUniformLocation(program, "heightMap"), heightUnit);
  const glm::vec2 bounds = drawing.heights.bounds();
  glProgramUniform2f(program, glGetUniformLocation(program, "heightBounds"), bounds.x, bounds.y);
  glBindTextureUnit(heightUnit, drawing.heights.texture());
}

void drawMesh(GLuint program, const RenderView& view, const GpuMesh& mesh) {
  glViewport(0, 0, view.width, view.height);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  glUseProgram(program);
  mesh.draw();
}

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
  gl::Texture texture = gl::makeTexture(GL_TEXTURE_2D);
  glTextureStorage2D(texture.name(), 1, GL_R8UI, mask.width, mask.height);
  // With the default filters an integer texture is incomplete, and reads as zero.
  glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(texture.name(), 0, 0, 0, mask.width, mask.height, GL_RED_INTEGER,
                      GL_UNSIGNED_BYTE, upward.data());
  return texture;
}

constexpr std::uint8_t noMethodAnswer = 2;

void clearMask(const Target& target) {
  const std::array<GLuint, 4> none = {noMethodAnswer, 0, 0, 0};
  glClearNamedFramebufferuiv(target.framebuffer(), GL_COLOR, 0, none.data());
  target.clearDepth();
}

std::string parameterUniforms(const Method& method) {
  std::string text;
  for (const auto& [name, parameter] : method.parameters) {
    text += fmt::format("uniform float {};\n", name);
  }
  return text;
}

double parameterValue(const Method& method, const std::string& name,
                      const std::map<std::string, double>& values) {
  const MethodParameter& parameter = method.parameters.at(name);
  const auto chosen = values.find(name);
  if (chosen == values.end()) return parameter.standard;
  if (!(chosen->second >= parameter.minimum && chosen->second <= parameter.maximum)) {
    throw InputError(fmt::format("method {}: parameter {} = {}, {} to {} expected", method.name,
                                 name, chosen->second, parameter.minimum, parameter.maximum));
  }
  return chosen->second;
}

}  // namespace

SamplesPass::SamplesPass(const fs::path& shaders)
    : program_(makePass(
          shaders,
          {readShader(shaders / "common/pixel.glsl"), readShader(shaders / "common/samples.frag")},
          {})) {}

SampleGrid SamplesPass::render(const RenderView& view, const GpuMesh& mesh) const {
  const Target target(view.width, view.height, {GL_R32I, GL_RG32F});
  const std::array<GLint, 4> nothing = {-1, 0, 0, 0};
  glClearNamedFramebufferiv(target.framebuffer(), GL_COLOR, 0, nothing.data());
  target.clearDepth();
  setView(program_.name(), view);
  drawMesh(program_.name(), view, mesh);
  const auto faces = target.read<std::int32_t>(0, GL_RED_INTEGER, GL_INT, 1);
  const auto parameters = target.read<glm::vec2>(1, GL_RG, GL_FLOAT, 1);
  throwOnGlError("reading the samples of a view");
  SampleGrid grid{view.width, view.height, std::vector<SurfaceSample>(faces.size())};
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (faces[i] >= 0) grid.samples[i] = {faces[i], parameters[i].x, parameters[i].y};
  }
  return grid;
}

ShadePass::ShadePass(const fs::path& shaders, Wrap wrap)
    : program_(makePass(
          shaders,
          {readShader(shaders / "common/pixel.glsl"), readShader(shaders / "common/relief.glsl"),
           readShader(shaders / "common/shade.frag")},
          reliefDefines(wrap, true))) {}

std::vector<std::uint8_t> ShadePass::render(const RenderView& view, const Drawing& drawing,
                                            const Mask& mask) const {
  const Target target(view.width, view.height, {GL_RGBA8});
  const std::array<GLfloat, 4> white = {1, 1, 1, 1};
  glClearNamedFramebufferfv(target.framebuffer(), GL_COLOR, 0, white.data());
  target.clearDepth();
  setView(program_.name(), view);
  setDrawing(program_.name(), drawing);
  const gl::Texture shadows = maskTexture(mask);
  glBindTextureUnit(maskUnit, shadows.name());
  glProgramUniform1i(program_.name(), glGetUniformLocation(program_.name(), "shadowMask"),
                     maskUnit);
  drawMesh(program_.name(), view, drawing.mesh);
  auto picture = target.read<std::uint8_t>(0, GL_RGB, GL_UNSIGNED_BYTE, 3);
  throwOnGlError("shading a picture");
  return picture;
}

MethodPass::MethodPass(const fs::path& shaders, const Method& method, Wrap wrap, TableFilter filter,
                       const std::map<std::string, double>& values)
    : name_(method.name), tables_(method.tables) {
  std::vector<std::string> defines = reliefDefines(wrap, method.tables.height);
  if (method.tables.horizon) defines.emplace_back("TABLE_HORIZON");
  if (method.tables.distance) defines.emplace_back("TABLE_DISTANCE");
  if (filter == TableFilter::hardware) defines.emplace_back("FILTER_HARDWARE");
  for (const auto& [name, value] : values) {
    if (method.parameters.count(name) == 0) {
      throw InputError(fmt::format("method {}: it has no parameter `{}`", method.name, name));
    }
  }
  program_ = makePass(shaders,
                      {readShader(shaders / "common/pixel.glsl"),
                       readShader(shaders / "common/relief.glsl"),
                       readShader(shaders / "common/tables.glsl"),
                       readShader(shaders / "common/osculating.glsl"),
                       readShader(shaders / "common/path.glsl"),
                       {method.source.file + " (parameters)", parameterUniforms(method)},
                       method.source,
                       readShader(shaders / "common/mask.frag")},
                      defines);
  for (const auto& [name, parameter] : method.parameters) {
    glProgramUniform1f(program_.name(), glGetUniformLocation(program_.name(), name.c_str()),
                       static_cast<GLfloat>(parameterValue(method, name, values)));
  }
}

void MethodPass::draw(const RenderView& view, const Drawing& drawing,
                      const GpuTables& tables) const {
  const GLuint program = program_.name();
  setView(program, view);
  setDrawing(program, drawing);
  const auto bind = [&](bool declared, const GpuTable* table, GLuint unit, const char* sampler,
                        const char* range) {
    if (!declared) return;
    if (table == nullptr) throw InternalError(fmt::format("method {} got no {}", name_, sampler));
    glBindTextureUnit(unit, table->texture());
    glProgramUniform1i(program, glGetUniformLocation(program, sampler), static_cast<GLint>(unit));
    const glm::vec2 bounds = table->range();
    glProgramUniform2f(program, glGetUniformLocation(program, range), bounds.x, bounds.y);
  };
  bind(tables_.horizon, tables.horizon, horizonUnit, "horizonTable", "horizonRange");
  bind(tables_.distance, tables.distance, distanceUnit, "distanceTable", "distanceRange");
  drawMesh(program, view, drawing.mesh);
}

Mask MethodPass::render(const RenderView& view, const Drawing& drawing,
                        const GpuTables& tables) const {
  const Target target(view.width, view.height, {GL_R8UI});
  clearMask(target);
  draw(view, drawing, tables);
  const auto answers = target.read<std::uint8_t>(0, GL_RED_INTEGER, GL_UNSIGNED_BYTE, 1);
  throwOnGlError("rendering a method's mask");
  Mask mask{view.width, view.height, std::vector<Shade>(answers.size(), Shade::none)};
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (answers[i] != noMethodAnswer) {
      mask.samples[i] = answers[i] == 0 ? Shade::lit : Shade::shadowed;
    }
  }
  return mask;
}

double MethodPass::frameMilliseconds(const RenderView& view, const Drawing& drawing,
                                     const GpuTables& tables, int frames) const {
  constexpr double enoughMilliseconds = 1000;
  using Clock = std::chrono::steady_clock;
  const Target target(view.width, view.height, {GL_R8UI});
  std::vector<double> milliseconds;
  double total = 0;
  for (int frame = 0; frame <= frames; ++frame) {
    glFinish();
    const Clock::time_point start = Clock::now();
    clearMask(target);
    draw(view, drawing, tables);
    glFinish();
    const std::chrono::duration<double, std::milli> elapsed = Clock::now() - start;
    if (frame == 0) continue;  // warms up
    milliseconds.push_back(elapsed.count());
    total += elapsed.count();
    if (total > enoughMilliseconds) break;
  }
  throwOnGlError("timing a method");
  const auto middle = milliseconds.begin() + static_cast<std::ptrdiff_t>(milliseconds.size() / 2);
  std::nth_element(milliseconds.begin(), middle, milliseconds.end());
  return *middle;
}

}  // namespace gnomon
