#include "render/passes/method_pass.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

#include "common/error.h"
#include "common/system/memory.h"
#include "render/gl_context.h"
#include "render/passes/method_program.h"
#include "render/target.h"

namespace gnomon::render {
namespace fs = std::filesystem;
namespace {

/// What mask.frag writes, and where it writes nothing.
constexpr std::uint8_t testShadowed = 1;
constexpr std::uint8_t drawnShadowed = 2;
constexpr std::uint8_t noAnswer = 4;

Mask maskOf(const RenderView& view, const std::vector<std::uint8_t>& answers, std::uint8_t bit) {
  Mask mask{view.width, view.height, std::vector<Shade>(answers.size(), Shade::none)};
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (answers[i] == noAnswer) continue;
    mask.samples[i] = (answers[i] & bit) == 0 ? Shade::lit : Shade::shadowed;
  }
  return mask;
}

/// A sample's shares are 0 to 1; this is where there is no sample.
constexpr float noShare = -1;

Visibility visibilityOf(const RenderView& view, std::vector<float> shares) {
  std::replace(shares.begin(), shares.end(), noShare, noSample);
  return {view.width, view.height, std::move(shares)};
}

Visibility visibilityOf(const Mask& mask) {
  Visibility visibility{mask.width, mask.height, std::vector<float>(mask.size(), noSample)};
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (mask.samples[i] == Shade::none) continue;
    visibility.shares[i] = mask.samples[i] == Shade::lit ? 1.0F : 0.0F;
  }
  return visibility;
}

/// The program that answers with shares; none where the method has only 0 and 1 to say.
/// @throws InputError for a disc without a horizon
std::optional<gl::Program> makeShareProgram(const fs::path& shaders, const Method& method,
                                            SoftAnswer soft, std::vector<std::string> defines) {
  const bool isDisc = soft == SoftAnswer::disc;
  if (isDisc && !method.hasHorizon) {
    throw InputError(fmt::format(
        "method {}: no function `float horizonSlope(Pixel pixel, LocalLight light)` in {}, which "
        "the light's disc could be held against",
        method.name, method.source.file));
  }
  if (!isDisc && !method.answersShares) return std::nullopt;
  defines.emplace_back(isDisc ? "ANSWER_DISC" : "ANSWER_SHARE");
  return makeMethodProgram(shaders, method, surfaceStage(shaders, "visibility.frag"), defines);
}

/// A texture pass keeps its values in the bits of the angles that it reads; without any, in floats.
horizon::TableBits resolvedBits(const GpuTables& tables) {
  return tables.angles != nullptr ? tables.angles->bits() : horizon::TableBits::thirtyTwo;
}

GLenum resolvedFormat(horizon::TableBits bits) {
  if (bits == horizon::TableBits::eight) return GL_RG8;
  return bits == horizon::TableBits::sixteen ? GL_RG16 : GL_RG32F;
}

int bytesPerResolved(horizon::TableBits bits) {
  return 2 * static_cast<int>(bits) / 8;
}

}  // namespace

MethodPass::MethodPass(const fs::path& shaders, const Method& method, relief::Wrap wrap,
                       TableFilter filter, const std::map<std::string, double>& values,
                       SoftAnswer soft)
    : name_(method.name),
      tables_(method.tables),
      bakes_(method.bakes),
      passes_(method.passes),
      hasLightMesh_(method.lightMesh.has_value()),
      values_(parameterValues(method, values)) {
  const std::vector<std::string> defines = methodDefines(method, wrap, filter);
  answer_ = makeMethodProgram(shaders, method, surfaceStage(shaders, "mask.frag"), defines);
  share_ = makeShareProgram(shaders, method, soft, defines);
  if (passes_.texture)
    resolve_ = makeMethodProgram(shaders, method, surfaceStage(shaders, "resolve.frag"), defines);
  if (passes_.lightDepth) lightDepth_.emplace(shaders);
  if (passes_.shadowVolumes) volumes_.emplace(shaders);
  for (const gl::Program* program :
       {&answer_, share_ ? &*share_ : nullptr, resolve_ ? &*resolve_ : nullptr}) {
    if (program != nullptr) setParameters(program->name(), values_);
  }
}

int MethodPass::depthSide() const {
  return static_cast<int>(values_.at("depth_side"));
}

std::uint64_t MethodPass::passBytes(const Drawing& drawing, const GpuTables& tables) const {
  std::uint64_t bytes = 0;
  if (passes_.texture) {
    bytes += static_cast<std::uint64_t>(drawing.texture->width) *
             static_cast<std::uint64_t>(drawing.texture->height) *
             static_cast<std::uint64_t>(bytesPerResolved(resolvedBits(tables)));
  }
  if (passes_.lightDepth) {
    const auto side = static_cast<std::uint64_t>(depthSide());
    bytes += side * side * sizeof(GLfloat);
  }
  return bytes;
}

/// The targets of one view's passes, kept from frame to frame.
class MethodPass::Frame {
 public:
  Frame(const MethodPass& pass, const RenderView& view, const Drawing& drawing,
        const GpuTables& tables)
      : pass_(pass),
        view_(view),
        drawing_(drawing),
        tables_(tables),
        isShare_(pass.share_ && drawing.lightRadius > 0),
        answers_(view.width, view.height,
                 isShare_ ? std::vector<GLenum>{GL_R32F, GL_R32F} : std::vector<GLenum>{GL_R8UI}) {
    if (pass.resolve_) {
      if (drawing.texture == nullptr) {
        throw InternalError(fmt::format("method {} got no texture plane", pass.name_));
      }
      resolved_.emplace(drawing.texture->width, drawing.texture->height,
                        std::vector<GLenum>{resolvedFormat(resolvedBits(tables))});
    }
    if (pass.lightDepth_) {
      const double side = pass.depthSide();
      requireMemory(side * side * sizeof(GLfloat),
                    fmt::format("method {}: depth_side = {}", pass.name_, side));
      light_ = lightView(seenFromLight().bounds(), drawing.light, pass.depthSide());
      depth_.emplace(light_.width, light_.height, std::vector<GLenum>{});
    }
    if (pass.volumes_) {
      counts_.emplace(view.width, view.height, std::vector<GLenum>{}, Target::Stencil::eightBits);
    }
  }

  /// Whether a pass fills something that depends on the light and on no view.
  [[nodiscard]] bool hasLightPasses() const { return resolved_ || depth_; }

  void drawLightPasses() const {
    if (resolved_) drawResolved();
    if (depth_) pass_.lightDepth_->draw(light_, seenFromLight(), *depth_);
  }

  /// The view's passes, after the light's.
  void drawView() const {
    if (counts_) pass_.volumes_->draw(view_, drawing_, *counts_);
    clearAnswers();
    const GLuint program = isShare_ ? pass_.share_->name() : pass_.answer_.name();
    setInputs(program, view_);
    bindPasses(program);
    drawMesh(answers_, program, view_, drawing_.mesh);
  }

  void draw() const {
    drawLightPasses();
    drawView();
  }

  [[nodiscard]] MethodAnswers masks() const {
    const auto bits = answers_.read<std::uint8_t>(0, GL_RED_INTEGER, GL_UNSIGNED_BYTE, 1);
    return {maskOf(view_, bits, drawnShadowed), maskOf(view_, bits, testShadowed)};
  }

  [[nodiscard]] VisibilityAnswers shares() const {
    return {visibilityOf(view_, answers_.read<float>(0, GL_RED, GL_FLOAT, 1)),
            visibilityOf(view_, answers_.read<float>(1, GL_RED, GL_FLOAT, 1))};
  }

 private:
  void clearAnswers() const {
    answers_.clearDepth();
    if (isShare_) {
      const std::array<GLfloat, 4> none = {noShare, 0, 0, 0};
      for (const GLint channel : {0, 1}) {
        glClearNamedFramebufferfv(answers_.framebuffer(), GL_COLOR, channel, none.data());
      }
    } else {
      const std::array<GLuint, 4> none = {noAnswer, 0, 0, 0};
      glClearNamedFramebufferuiv(answers_.framebuffer(), GL_COLOR, 0, none.data());
    }
  }

  /// What the pass from the light draws.
  [[nodiscard]] const GpuMesh& seenFromLight() const {
    if (!pass_.hasLightMesh_) return drawing_.mesh;
    if (drawing_.lightMesh == nullptr) {
      throw InternalError(fmt::format("method {} got no mesh for its light", pass_.name_));
    }
    return *drawing_.lightMesh;
  }

  void drawResolved() const {
    const std::array<GLfloat, 4> nothing = {0, 0, 0, 0};
    glClearNamedFramebufferfv(resolved_->framebuffer(), GL_COLOR, 0, nothing.data());
    resolved_->clearDepth();
    setInputs(pass_.resolve_->name(), *drawing_.texture);
    drawMesh(*resolved_, pass_.resolve_->name(), *drawing_.texture, drawing_.mesh);
  }

  void setInputs(GLuint program, const RenderView& view) const {
    setView(program, view);
    setDrawing(program, drawing_);
    bindTables(program, pass_.name_, pass_.tables_, tables_);
    bindBakes(program, pass_.name_, pass_.bakes_, tables_);
  }

  /// What the earlier passes of the frame left.
  void bindPasses(GLuint program) const {
    if (resolved_) {
      bindTexture(program, TextureUnit::resolved, resolved_->colourTexture(0), "resolvedMap");
      setUniform(program, "resolvedOrigin", glm::ivec2(drawing_.texture->texelWindow));
    }
    if (depth_) {
      bindTexture(program, TextureUnit::lightDepth, depth_->depthTexture(), "lightDepthMap");
      // From clip space to texels of the map and depth 0 to 1.
      const auto side = static_cast<float>(light_.width);
      const glm::mat4 mapFromClip = glm::scale(glm::mat4(1), {side / 2, side / 2, 0.5F}) *
                                    glm::translate(glm::mat4(1), glm::vec3(1, 1, 1));
      setUniform(program, "lightMapFromWorld", mapFromClip * light_.clipFromWorld);
      const auto diameter = static_cast<float>(2.0002 * seenFromLight().bounds().radius);
      setUniform(program, "lightMapLengths", glm::vec2(diameter / side, diameter));
    }
    if (counts_) {
      bindTexture(program, TextureUnit::shadowCount, counts_->depthTexture(), "shadowCounts");
    }
  }

  const MethodPass& pass_;
  const RenderView& view_;
  const Drawing& drawing_;
  const GpuTables& tables_;
  RenderView light_;
  std::optional<Target> resolved_;
  std::optional<Target> depth_;
  std::optional<Target> counts_;
  bool isShare_;
  Target answers_;
};

MethodAnswers MethodPass::render(const RenderView& view, const Drawing& drawing,
                                 const GpuTables& tables) const {
  // The light's centre alone: its disc is for renderVisibility.
  Drawing point = drawing;
  point.lightRadius = 0;
  const Frame frame(*this, view, point, tables);
  frame.draw();
  MethodAnswers answers = frame.masks();
  throwOnGlError("rendering a method's mask");
  return answers;
}

VisibilityAnswers MethodPass::renderVisibility(const RenderView& view, const Drawing& drawing,
                                               const GpuTables& tables) const {
  if (!share_ || !(drawing.lightRadius > 0)) {
    const MethodAnswers answers = render(view, drawing, tables);
    return {visibilityOf(answers.drawn), visibilityOf(answers.test)};
  }
  const Frame frame(*this, view, drawing, tables);
  frame.draw();
  VisibilityAnswers answers = frame.shares();
  throwOnGlError("rendering a method's shares of light");
  return answers;
}

FrameTimes MethodPass::frameTimes(const RenderView& view, const Drawing& drawing,
                                  const GpuTables& tables, int frames, FirstFrame first,
                                  FrameClock clock) const {
  const Frame frame(*this, view, drawing, tables);
  const double every = medianFrameMilliseconds([&] { frame.draw(); }, frames, first, clock);
  if (!frame.hasLightPasses()) return {every, every};
  // At least one frame has been drawn: the light's passes are filled.
  const auto drawView = [&] { frame.drawView(); };
  return {every, medianFrameMilliseconds(drawView, frames, FirstFrame::isWarm, clock)};
}

}  // namespace gnomon::render
