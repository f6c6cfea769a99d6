#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "model/pane_figures.h"
#include "render/gl_objects.h"
#include "render/passes/drawing.h"
#include "viewer/session/drawn_scene.h"
#include "viewer/session/truth_worker.h"
#include "viewer/session/view_state.h"

namespace gnomon::app {

/// What is known of the truth for the camera and light shown.
struct KnownTruth {
  std::map<study::MeshChoice, PartialTruth> truths;
  std::optional<image::Image> picture;  ///< the displaced surface by its own rays
  bool stale = false;                   ///< of the light before: to look at, not to measure with
  std::uint64_t serial = 0;             ///< changes whenever any of it does
};

/// One pane as it is drawn.
struct PanePicture {
  GLuint texture = 0;
  bool topDown = false;                ///< row 0 of the texture is the picture's top
  std::string note;                    ///< why the picture is not what was asked for; may be empty
  std::optional<PaneFigures> figures;  ///< of the first operand against the second, or the truth
  std::optional<PaneFigures> partFigures = {};  ///< the same in the rectangle, where there is one
};

/// Draws the pictures of the panes into textures, and keeps them until something changes.
class PanePictures {
 public:
  explicit PanePictures(const std::filesystem::path& shaders);

  /// Compiles its own shaders again. @throws InputError with file and line
  void reloadShaders(const std::filesystem::path& shaders);

  /// Draws what has changed.
  /// @param serial  changes with anything but the truth and the panes' contents: scene, camera,
  ///   light, parameters, shaders
  /// @return whether anything was drawn
  bool draw(const DrawnScene& scene, const ViewState& state, const KnownTruth& truth,
            std::uint64_t serial);

  [[nodiscard]] const PanePicture& pane(std::size_t index) const { return panes_.at(index).shown; }
  /// What a pane shows: a method's answers, or the truth's as far as traced. Null for others. Valid
  /// until the next drawing.
  [[nodiscard]] const Answers* answersOf(const DrawnScene& scene, const ViewState& state,
                                         const KnownTruth& truth, const PaneContent& content);
  /// The pixels that a mesh shows.
  [[nodiscard]] surface::SampleGrid samplesOf(const DrawnScene& scene, study::MeshChoice mesh,
                                              const Camera& camera) const;
  /// The samples at the texel centres of a mesh.
  [[nodiscard]] surface::SampleGrid texelsOf(const render::RenderView& plane,
                                             const render::GpuMesh& mesh) const {
    return samples_.render(plane, mesh);
  }

  /// The mesh whose pixels a pane shows; none where its two methods draw different ones, or one is
  /// not there yet.
  [[nodiscard]] static std::optional<study::MeshChoice> meshOf(const DrawnScene& scene,
                                                               const PaneContent& content);

 private:
  struct Programs {
    Programs(const std::filesystem::path& shaders, relief::Wrap wrapOfRelief)
        : wrap(wrapOfRelief),
          shadeBase(shaders, wrapOfRelief, render::DrawnMesh::base),
          shadeDisplaced(shaders, wrapOfRelief, render::DrawnMesh::displaced),
          lines(shaders) {}
    relief::Wrap wrap;
    render::ShadePass shadeBase, shadeDisplaced;
    render::LinePass lines;
  };
  struct Key {
    PaneContent content;
    std::uint64_t serial = 0;
    std::uint64_t truth = 0;
    bool directions = false;
    friend bool operator==(const Key&, const Key&) = default;
  };
  struct Pane {
    std::optional<Key> key;
    std::optional<ViewPart> part;  ///< that the figures are of
    std::unique_ptr<render::Target> target;
    render::gl::Texture image;
    int imageWidth = 0, imageHeight = 0;
    PanePicture shown;
  };
  struct CachedAnswers {
    std::uint64_t serial;
    Answers answers;
  };

  void drawPane(Pane& pane, const PaneContent& content, const DrawnScene& scene,
                const ViewState& state, const KnownTruth& truth, std::uint64_t serial);
  void shade(Pane& pane, const DrawnScene& scene, const ViewState& state, study::MeshChoice mesh,
             const Answers& answers);
  static void showImage(Pane& pane, const image::Image& image);
  const Answers* methodAnswers(const DrawnScene& scene, const ViewState& state,
                               const std::string& label, std::uint64_t serial);
  /// Computes the figures of a pane; none where it shows nothing that can be wrong.
  void measure(Pane& pane, const PaneContent& content, const DrawnScene& scene,
               const ViewState& state, const KnownTruth& truth, std::uint64_t serial);

  std::filesystem::path shaders_;
  std::optional<Programs> programs_;
  render::SamplesPass samples_;
  std::map<std::string, CachedAnswers> answers_;
  std::array<Pane, 4> panes_;
  std::uint64_t serial_ = 0;
};

}  // namespace gnomon::app
