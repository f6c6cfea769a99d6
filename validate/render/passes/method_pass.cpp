#include "render/passes/method_pass.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

#include "common/error.h"
#include "common/system/memory.h"
#include "render/gl_context.h"
#include "render/shader_files.h"

namespace gnomon::render {
namespace fs = std::filesystem;
namespace {

/// A pass that resolves texels keeps its values in the bits of the angles that it reads; without
/// any, in floats. Where charts overlap, always in floats: fewer bits do not hold charts' numbers.
horizon::TableBits bitsOf(const OwnPass& pass, const GpuTables& tables, bool chartsOverlap) {
  if (pass.isMarked() && chartsOverlap) return horizon::TableBits::thirtyTwo;
  if (pass.bits) return *pass.bits;
  return tables.angles != nullptr ? tables.angles->bits() : horizon::TableBits::thirtyTwo;
}

double targetBytes(const OwnPass& pass, const GpuTables& tables, bool chartsOverlap,
                   glm::dvec2 size) {
  const double levels = pass.mips ? 4.0 / 3 : 1;
  return size.x * size.y * levels * pass.storedChannels() *
         static_cast<double>(bitsOf(pass, tables, chartsOverlap)) / 8;
}

Target makeTarget(const OwnPass& pass, const GpuTables& tables, bool chartsOverlap,
                  glm::ivec2 size) {
  const auto channel = static_cast<std::size_t>(pass.storedChannels() - 1);
  const Target::Reading reading = pass.mips         ? Target::Reading::mips
                                  : pass.isMarked() ? Target::Reading::texels
                                                    : Target::Reading::filtered;
  return {size.x,
          size.y,
          {pixelFormat(bitsOf(pass, tables, chartsOverlap)).sized.at(channel)},
          Target::Stencil::none,
          reading};
}

/// The matrix from a view's clip space to its pixels and depth 0 to 1.
glm::dmat4 mapFromClip(glm::dvec2 size) {
  return glm::scale(glm::dmat4(1), glm::dvec3(size / 2.0, 0.5)) *
         glm::translate(glm::dmat4(1), glm::dvec3(1, 1, 1));
}

}  // namespace

MethodPass::MethodPass(const fs::path& shaders, const Method& method, relief::Wrap wrap,
                       TableFilter filter, const std::map<std::string, double>& values,
                       SoftAnswer soft, std::shared_ptr<const SharedTargets> targets)
    : name_(method.name),
      tables_(method.tables),
      bakes_(method.bakes),
      textures_(method.textures),
      pictures_(gpuTextures(method)),
      passes_(method.passes),
      own_(ownPasses(method)),
      readsLightDepth_(method.passes.lightDepth || placeOfWord(method.code, "lightDepthOf") ||
                       placeOfWord(method.code, "lightDepthMap")),
      hasLightMesh_(method.lightMesh.has_value()),
      values_(parameterValues(method, values)),
      targets_(std::move(targets)) {
  const std::vector<std::string> defines = methodDefines(method, wrap, filter);
  std::vector<std::string> softDefines = defines;
  const std::optional<std::string> added = softDefine(method, soft);
  if (added) softDefines.push_back(*added);
  answer_ = makeMethodProgram(shaders, method, surfaceStage(shaders, "mask.frag"), defines);
  const MethodStage shareStage = surfaceStage(shaders, "visibility.frag");
  if (added) share_ = makeMethodProgram(shaders, method, shareStage, softDefines);
  for (const OwnPass& pass : own_) {
    const MethodStage stage = ownPassStage(shaders, method, pass, own_);
    ownPrograms_.push_back(makeMethodProgram(shaders, method, stage, defines));
    setParameters(ownPrograms_.back().name(), method, values_);
  }
  if (!own_.empty()) nothing_ = makeNoNumber(GL_TEXTURE_2D);
  if (seesLight() || passes_.cameraDepth) depth_.emplace(shaders);
  if (passes_.shadowVolumes) volumes_.emplace(shaders);
  setParameters(answer_.name(), method, values_);
  if (share_) setParameters(share_->name(), method, values_);
}

int MethodPass::depthSide() const {
  return static_cast<int>(values_.at("depth_side"));
}

bool MethodPass::reads(const std::string& sampler) const {
  const auto isIn = [&](const gl::Program& program) {
    return glGetUniformLocation(program.name(), sampler.c_str()) >= 0;
  };
  return isIn(answer_) || (share_ && isIn(*share_)) ||
         std::any_of(ownPrograms_.begin(), ownPrograms_.end(), isIn);
}

std::uint64_t MethodPass::textureBytes() const {
  std::uint64_t bytes = 0;
  for (const GpuTexture& picture : pictures_) bytes += picture.byteCount();
  return bytes;
}

std::uint64_t MethodPass::passBytes(const RenderView* view, const Drawing& drawing,
                                    const GpuTables& tables) const {
  std::uint64_t bytes = 0;
  const auto sizeOf = [&](PassRaster root) -> glm::dvec2 {
    if (root == PassRaster::texture) return {drawing.texture->width, drawing.texture->height};
    if (root == PassRaster::light) return glm::dvec2(depthSide());
    return view == nullptr ? glm::dvec2(0) : glm::dvec2(view->width, view->height);
  };
  for (const OwnPass& pass : own_) {
    bytes += static_cast<std::uint64_t>(
        targetBytes(pass, tables, drawing.mesh.chartsOverlap(), sizeOf(pass.root)));
  }
  if (readsLightDepth_) {
    const auto side = static_cast<std::uint64_t>(depthSide());
    bytes += side * side * sizeof(GLfloat);
  }
  if (passes_.cameraDepth && view != nullptr) {
    const glm::dvec2 size = sizeOf(PassRaster::camera);
    bytes += static_cast<std::uint64_t>(size.x * size.y) * sizeof(GLfloat);
  }
  return bytes;
}

/// The targets of one view's passes, kept from frame to frame.
class MethodPass::Frame {
 public:
  Frame(const MethodPass& pass, const RenderView& view, const Drawing& drawing,
        const GpuTables& tables, const LoopCheck* check = nullptr)
      : pass_(pass),
        view_(view),
        drawing_(drawing),
        tables_(tables),
        check_(check),
        isShare_(pass.answersInShares(drawing)),
        shared_(pass.targets_ ? *pass.targets_ : own_),
        answers_(shared_.get(view.width, view.height,
                             isShare_ ? std::vector<GLenum>{GL_R32F, GL_R32F, GL_R8UI}
                                      : std::vector<GLenum>{GL_R8UI})) {
    if (pass.seesLight()) {
      const double side = pass.depthSide();
      requireMemory(side * side * sizeof(GLfloat),
                    fmt::format("method {}: depth_side = {}", pass.name_, side));
      light_ = lightView(seenFromLight().bounds(), drawing.light.direction, pass.depthSide());
    }
    for (const OwnPass& own : pass.own_) {
      const RenderView& on = viewOf(own.root);
      const bool chartsOverlap = drawing.mesh.chartsOverlap();
      requireMemory(targetBytes(own, tables, chartsOverlap, {on.width, on.height}),
                    fmt::format("method {}: pass `{}` of {} × {} texels", pass.name_, own.name,
                                on.width, on.height));
      targets_.push_back(makeTarget(own, tables, chartsOverlap, {on.width, on.height}));
    }
    if (pass.passes_.lightDepth && !pass.passes_.hasOwn(PassRaster::light)) {
      depth_.emplace(light_.width, light_.height, std::vector<GLenum>{});
    }
    if (pass.passes_.cameraDepth) {
      requireCamera();
      cameraDepth_.emplace(view.width, view.height, std::vector<GLenum>{});
    }
    if (pass.volumes_) {
      counts_.emplace(view.width, view.height, std::vector<GLenum>{}, Target::Stencil::eightBits);
    }
    clearAnswers();  // so that the first frame's time is not that of getting the memory
  }

  /// Whether a pass fills something that depends on the light and on no view.
  [[nodiscard]] bool hasLightPasses() const {
    return depth_ || std::any_of(pass_.own_.begin(), pass_.own_.end(), isOfTheLight);
  }

  void drawLightPasses() const {
    if (depth_) pass_.depth_->draw(light_, seenFromLight(), *depth_, Sides::both);
    drawOwn(true);
  }

  /// All that the answers read.
  void drawPasses() const {
    drawLightPasses();
    drawViewPasses();
  }

  /// The view's passes and the answers, after the light's passes.
  void drawView() const {
    drawViewPasses();
    clearAnswers();
    drawAnswers(isShare_ ? pass_.share_->name() : pass_.answer_.name(), answers_);
  }

  void draw() const {
    drawLightPasses();
    drawView();
  }
  void drawBy(const FrameDrawer& drawer) const {
    if (!drawer) return draw();
    drawer([this] { draw(); });
  }

  [[nodiscard]] MethodAnswers masks() const {
    return answersOf(view_, answers_.read<std::uint8_t>(0, GL_RED_INTEGER, GL_UNSIGNED_BYTE, 1));
  }

  /// What a program counts for every sample's answer, once its passes are drawn; `noShare` where
  /// there is no sample.
  [[nodiscard]] std::vector<float> counted(GLuint program) const {
    const Target& counts = shared_.get(view_.width, view_.height, {GL_R32F});
    counts.clearDepth();
    clearShares(counts, 1);
    drawAnswers(program, counts);
    return counts.read<float>(0, GL_RED, GL_FLOAT, 1);
  }

  [[nodiscard]] VisibilityAnswers shares() const {
    return answersOf(view_, answers_.read<float>(0, GL_RED, GL_FLOAT, 1),
                     answers_.read<float>(1, GL_RED, GL_FLOAT, 1),
                     answers_.read<std::uint8_t>(2, GL_RED_INTEGER, GL_UNSIGNED_BYTE, 1));
  }

 private:
  void drawViewPasses() const {
    if (counts_) pass_.volumes_->draw(view_, drawing_, *counts_);
    if (cameraDepth_) {
      pass_.depth_->draw(view_, drawing_.mesh, *cameraDepth_, Sides::front);
    }
    drawOwn(false);
  }

  void clearAnswers() const {
    answers_.clearDepth();
    if (isShare_) {
      clearShares(answers_, 2);
      const std::array<GLuint, 4> notMet = {0, 0, 0, 0};
      glClearNamedFramebufferuiv(answers_.framebuffer(), GL_COLOR, 2, notMet.data());
    } else {
      const std::array<GLuint, 4> none = {noAnswer, 0, 0, 0};
      glClearNamedFramebufferuiv(answers_.framebuffer(), GL_COLOR, 0, none.data());
    }
  }

  /// Sets attachments to what there is where no sample is.
  static void clearShares(const Target& target, GLint attachments) {
    const std::array<GLfloat, 4> none = {noShare, 0, 0, 0};
    for (GLint channel = 0; channel < attachments; ++channel) {
      glClearNamedFramebufferfv(target.framebuffer(), GL_COLOR, channel, none.data());
    }
  }

  /// The surface by a program that reads all that the passes left.
  void drawAnswers(GLuint program, const Target& target) const {
    setInputs(program, view_);
    bindPasses(program, pass_.own_.size());
    drawMesh(target, program, view_, drawing_.mesh);
  }

  /// What the pass from the light draws.
  [[nodiscard]] const GpuMesh& seenFromLight() const {
    if (!pass_.hasLightMesh_) return drawing_.mesh;
    if (drawing_.lightMesh == nullptr) {
      throw InternalError(fmt::format("method {} got no mesh for its light", pass_.name_));
    }
    return *drawing_.lightMesh;
  }

  static bool isOfTheLight(const OwnPass& pass) { return pass.root != PassRaster::camera; }

  void requireCamera() const {
    if (view_.atlasTiles.x == 0) return;
    throw InternalError(fmt::format("method {} needs a camera's view", pass_.name_));
  }

  /// What a pass of the method's own is drawn over.
  [[nodiscard]] const RenderView& viewOf(PassRaster root) const {
    if (root == PassRaster::light) return light_;
    if (root == PassRaster::texture) {
      if (drawing_.texture == nullptr) {
        throw InternalError(fmt::format("method {} got no texture plane", pass_.name_));
      }
      return *drawing_.texture;
    }
    requireCamera();
    return view_;
  }

  void drawOwn(bool ofTheLight) const {
    for (std::size_t i = 0; i < pass_.own_.size(); ++i) {
      if (isOfTheLight(pass_.own_[i]) == ofTheLight) drawOwn(i);
    }
  }

  void drawOwn(std::size_t place) const {
    if (check_ != nullptr) requireEnds(place);
    drawOwn(place, pass_.ownPrograms_[place].name(), pass_.own_[place].clear);
    targets_[place].makeMips();
  }

  /// Refuses a pass whose loops do not end.
  void requireEnds(std::size_t place) const {
    drawOwn(place, check_->pass(place), {});
    const std::vector<float> ended = targets_[place].read<float>(0, GL_RED, GL_FLOAT, 1);
    const auto count = std::count_if(ended.begin(), ended.end(), [](float one) { return one > 0; });
    if (count == 0) return;
    throw InputError(
        fmt::format("the loops of its pass `{}` turn {} times or more at {} texels, "
                    "fewer expected",
                    pass_.own_[place].name, mostLoopIterations, count));
  }

  void drawOwn(std::size_t place, GLuint program, const std::array<float, 4>& clear) const {
    const OwnPass& own = pass_.own_[place];
    const Target& target = targets_[place];
    const RenderView& view = viewOf(own.root);
    setInputs(program, view);
    bindPasses(program, place);
    if (own.raster == PassRaster::filter) {
      target.bind();
      glViewport(0, 0, target.width(), target.height());
      drawPlane(program);
    } else {
      glClearNamedFramebufferfv(target.framebuffer(), GL_COLOR, 0, clear.data());
      target.clearDepth();
      const bool isLight = own.raster == PassRaster::light;
      drawMesh(target, program, view, isLight ? seenFromLight() : drawing_.mesh,
               isLight ? Sides::both : Sides::front);
    }
  }

  void setInputs(GLuint program, const RenderView& view) const {
    setView(program, view);
    setDrawing(program, drawing_);
    bindTables(program, pass_.name_, pass_.tables_, tables_);
    bindBakes(program, pass_.name_, pass_.bakes_, tables_);
    bindOwnTextures(program, pass_.textures_, pass_.pictures_);
  }

  /// What the earlier passes of the frame left.
  /// @param known  passes of the method's own that have been drawn
  void bindPasses(GLuint program, std::size_t known) const {
    for (std::size_t i = 0; i < pass_.own_.size(); ++i) {
      const OwnPass& own = pass_.own_[i];
      bindTexture(program, passUnit(i),
                  i < known ? targets_[i].colourTexture(0) : pass_.nothing_.name(),
                  own.sampler().c_str());
      setUniform(program, own.origin().c_str(), glm::ivec2(viewOf(own.root).texelWindow));
    }
    if (pass_.seesLight()) {
      bindTexture(program, TextureUnit::lightDepth, lightDepth(known), "lightDepthMap");
      const auto side = static_cast<float>(light_.width);
      const glm::mat4 fromClip(mapFromClip({light_.width, light_.width}));
      setUniform(program, "lightMapFromWorld", fromClip * light_.clipFromWorld);
      const auto diameter = static_cast<float>(2.0002 * seenFromLight().bounds().radius);
      setUniform(program, "lightMapLengths", glm::vec2(diameter / side, diameter));
    }
    if (cameraDepth_) {
      const glm::dmat4 map =
          mapFromClip({view_.width, view_.height}) * glm::dmat4(view_.clipFromWorld);
      bindTexture(program, TextureUnit::cameraDepth, cameraDepth_->depthTexture(),
                  "cameraDepthMap");
      setUniform(program, "cameraMapFromWorld", glm::mat4(map));
      setUniform(program, "worldFromCameraMap", glm::mat4(glm::inverse(map)));
    }
    if (counts_) {
      bindTexture(program, TextureUnit::shadowCount, counts_->depthTexture(), "shadowCounts");
    }
  }

  /// The depth that the light sees; no number while it has not been drawn.
  [[nodiscard]] GLuint lightDepth(std::size_t known) const {
    if (depth_) return depth_->depthTexture();
    for (std::size_t i = 0; i < known; ++i) {
      if (pass_.own_[i].raster == PassRaster::light) return targets_[i].depthTexture();
    }
    return pass_.nothing_.name();
  }

  const MethodPass& pass_;
  const RenderView& view_;
  const Drawing& drawing_;
  const GpuTables& tables_;
  const LoopCheck* check_;  ///< of the passes, before each is drawn; null for none
  RenderView light_;
  std::vector<Target> targets_;  ///< of the method's own passes
  std::optional<Target> depth_;
  std::optional<Target> cameraDepth_;
  std::optional<Target> counts_;
  bool isShare_;
  SharedTargets own_;  ///< of a pass that holds none
  const SharedTargets& shared_;
  const Target& answers_;
};

MethodAnswers MethodPass::render(const RenderView& view, const Drawing& drawing,
                                 const GpuTables& tables, const FrameDrawer& drawer) const {
  // The light's centre alone: its disc is for renderVisibility.
  Drawing point = drawing;
  point.light.radius = 0;
  const Frame frame(*this, view, point, tables);
  frame.drawBy(drawer);
  hasDrawnMask_ = true;
  MethodAnswers answers = frame.masks();
  throwOnGlError("rendering a method's mask");
  return answers;
}

VisibilityAnswers MethodPass::renderVisibility(const RenderView& view, const Drawing& drawing,
                                               const GpuTables& tables,
                                               const FrameDrawer& drawer) const {
  if (!answersInShares(drawing)) return asShares(render(view, drawing, tables, drawer));
  const Frame frame(*this, view, drawing, tables);
  frame.drawBy(drawer);
  hasDrawnShares_ = true;
  VisibilityAnswers answers = frame.shares();
  throwOnGlError("rendering a method's shares of light");
  return answers;
}

std::vector<std::size_t> MethodPass::endlessSamples(const RenderView& view, const Drawing& drawing,
                                                    const GpuTables& tables,
                                                    const LoopCheck& check) const {
  Drawing answered = drawing;
  if (!answersInShares(drawing)) answered.light.radius = 0;
  const Frame frame(*this, view, answered, tables, &check);
  frame.drawPasses();
  const std::vector<float> turns = frame.counted(check.answer());
  throwOnGlError("counting the turns of a method's loops");
  std::vector<std::size_t> endless;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    if (turns[i] >= static_cast<float>(mostLoopIterations)) endless.push_back(i);
  }
  return endless;
}

FrameCosts MethodPass::frameCosts(const RenderView& view, const Drawing& drawing,
                                  const GpuTables& tables, FrameLimits limits,
                                  std::optional<double> drawnIn, FrameClock clock,
                                  const TexelCounter& counter) const {
  const Frame frame(*this, view, drawing, tables);
  if (drawnIn) frame.drawPasses();  // it may be the only one: what follows reads them too
  FrameCosts costs;
  costs.every =
      medianFrameMilliseconds([&] { frame.draw(); }, limits, {isWarm(drawing), drawnIn}, clock);
  costs.still = costs.every;
  if (frame.hasLightPasses()) {
    const auto drawView = [&] { frame.drawView(); };
    costs.still = medianFrameMilliseconds(drawView, limits, {true}, clock);
  }
  costs.texels = meanOfSamples(frame.counted(counter.program()));
  throwOnGlError("counting the texels that a method reads");
  return costs;
}

}  // namespace gnomon::render
