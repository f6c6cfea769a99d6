#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/frame_timer.h"
#include "render/gl_objects.h"
#include "render/method.h"
#include "render/passes/drawing.h"
#include "render/passes/method_answers.h"
#include "render/passes/method_program.h"
#include "render/passes/texel_counter.h"

namespace gnomon::render {

/// What a method's frames cost.
struct FrameCosts {
  /// Median time of a frame with all its passes, milliseconds: see medianFrameMilliseconds.
  double every = 0;
  /// The same while the light stands still: without the passes whose result depends on the light
  /// alone (a depth map, a texture pass), which are kept from one frame to the next.
  double still = 0;
  /// Texels that the answer of a sample reads (TexelCounter), the mean over the view's samples,
  /// without other passes than the last. NaN for a view without a sample.
  double texels = 0;
};

/// Calls `draw` once, which draws a frame; it may measure how long that takes.
using FrameDrawer = std::function<void(const std::function<void()>& draw)>;

/// A method ready to render: its shaders and the passes that it declares.
class MethodPass {
 public:
  /// @param values  of the method's parameters; others have the authors' values
  /// @param targets  that its answers are drawn into, which other passes use in turn; null where
  ///                 every frame shall have its own
  /// @throws InputError for a shader that does not compile, an unknown or out-of-range parameter,
  /// or
  ///   `SoftAnswer::disc` of a method without a horizon
  MethodPass(const std::filesystem::path& shaders, const Method& method, relief::Wrap wrap,
             TableFilter filter, const std::map<std::string, double>& values,
             SoftAnswer soft = SoftAnswer::own,
             std::shared_ptr<const SharedTargets> targets = nullptr);

  /// The method's answers for every sample of the view.
  /// @param drawing  with `volumes` for shadow volumes, with `texture` for a texture pass, with
  ///                 `lightMesh` for a method that declares one
  /// @param drawer   draws the frame that the answers are read from; may be left out
  [[nodiscard]] MethodAnswers render(const RenderView& view, const Drawing& drawing,
                                     const GpuTables& tables, const FrameDrawer& drawer = {}) const;

  /// The same of a light with a radius. With radius 0 every share is 0 or 1, exactly as `render`
  /// says.
  [[nodiscard]] VisibilityAnswers renderVisibility(const RenderView& view, const Drawing& drawing,
                                                   const GpuTables& tables,
                                                   const FrameDrawer& drawer = {}) const;

  /// Whether answers for such a light, a point or a disc, have been drawn: the driver has compiled
  /// for it.
  [[nodiscard]] bool isWarm(const Drawing& drawing) const {
    return answersInShares(drawing) ? hasDrawnShares_ : hasDrawnMask_;
  }

  /// The samples at which the loops of the answer for the drawing's light turn `mostLoopIterations`
  /// times or more.
  /// @param check  of the same method and settings
  /// @throws InputError for a pass whose loops do
  [[nodiscard]] std::vector<std::size_t> endlessSamples(const RenderView& view,
                                                        const Drawing& drawing,
                                                        const GpuTables& tables,
                                                        const LoopCheck& check) const;

  /// Of the passes that answer for the drawing's light, a point or a disc.
  /// @param drawnIn  the time of a frame of the same view and drawing, milliseconds, if the answers
  ///                 were drawn while the pass was warm: it counts as the first of those timed
  /// @param counter  of the same method and settings
  [[nodiscard]] FrameCosts frameCosts(const RenderView& view, const Drawing& drawing,
                                      const GpuTables& tables, FrameLimits limits,
                                      std::optional<double> drawnIn, FrameClock clock,
                                      const TexelCounter& counter) const;

  /// Whether a program of its frame reads a texture, by the sampler's name: what only bakes read is
  /// not there while frames are drawn.
  [[nodiscard]] bool reads(const std::string& sampler) const;

  /// Bytes of the pictures that the method brings.
  [[nodiscard]] std::uint64_t textureBytes() const;
  /// Bytes of the textures that its passes fill and read again in every frame.
  /// @param view  of a camera, for what is as large as its picture; null for none
  [[nodiscard]] std::uint64_t passBytes(const RenderView* view, const Drawing& drawing,
                                        const GpuTables& tables) const;

 private:
  class Frame;

  [[nodiscard]] bool answersInShares(const Drawing& drawing) const {
    return share_ && drawing.light.isSoft();
  }
  [[nodiscard]] bool seesLight() const {
    return passes_.lightDepth || passes_.hasOwn(PassRaster::light);
  }
  /// A side of the depth map, texels.
  [[nodiscard]] int depthSide() const;

  std::string name_;
  MethodTables tables_;
  std::vector<MethodBake> bakes_;
  std::vector<MethodTexture> textures_;
  std::vector<GpuTexture> pictures_;
  MethodPasses passes_;
  std::vector<OwnPass> own_;  ///< with the one that resolves texels first
  bool readsLightDepth_;
  bool hasLightMesh_;
  std::map<std::string, double> values_;          ///< every parameter's
  std::shared_ptr<const SharedTargets> targets_;  ///< may be null
  gl::Program answer_;
  std::optional<gl::Program> share_;      ///< of a method that answers with a share
  std::vector<gl::Program> ownPrograms_;  ///< one a pass of `own_`
  gl::Texture nothing_;                   ///< read in the place of a target that is not there yet
  std::optional<DepthPass> depth_;
  std::optional<ShadowVolumePass> volumes_;
  // What the driver keeps of a program once it is drawn with; no result depends on it.
  mutable bool hasDrawnMask_ = false;
  mutable bool hasDrawnShares_ = false;
};

}  // namespace gnomon::render
