#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands/view_command.h"
#include "viewer/session/background_worker.h"
#include "viewer/session/drawn_scene.h"
#include "viewer/session/opened_study.h"
#include "viewer/session/pane_pictures.h"
#include "viewer/session/truth_worker.h"
#include "viewer/session/view_state.h"

namespace gnomon::app {

/// The method that a study is first looked at with: the first of its own that can be shown, but for
/// the control `unshadowed`, which casts no shadow to look at, where there is another one.
const std::string& firstMethod(const OpenedStudy& opened);

/// What the window opens with: the study's first camera (or one that sees all of the surface), its
/// first light, and the panes and overlays that are asked for; by default `firstMethod` beside the
/// truth.
/// @throws UsageError for contents that are none, or other than one, two or four of them; for a
///   rectangle that is none
ViewState firstView(const OpenedStudy& opened);

/// A scene that was asked for, or why there is none.
struct SceneResult {
  std::shared_ptr<const SceneData> scene;
  std::string error;
};

/// What stands between a person's choices and the pictures: asks the background for what is
/// missing, takes what it has made, and draws. Made and used by the thread that has the context.
class ViewSession {
 public:
  /// Reads the study, and begins with its first view; waits for nothing else.
  /// @param wake  called from other threads when there is something new
  /// @throws InputError as readStudy, UsageError as firstView
  ViewSession(const cli::ViewRequest& request, const std::function<void()>& wake);

  ViewState& state() { return state_; }
  [[nodiscard]] const ViewState& state() const { return state_; }

  /// Brings everything up to date with the state and with what the background has made.
  /// @return whether a picture was drawn anew
  bool update();

  /// All that was asked for is there, the truth to its last sample.
  [[nodiscard]] bool isComplete() const;
  /// A scene is there to draw.
  [[nodiscard]] bool hasScene() const { return scene_.data() != nullptr; }

  [[nodiscard]] const SceneData* scene() const { return scene_.data(); }
  [[nodiscard]] const study::StudySpec& study() const {
    return hasScene() ? *scene_.data()->study : *opened_.study;
  }
  /// The study as it was opened, before any slider.
  [[nodiscard]] const study::StudySpec& opened() const { return *opened_.study; }
  [[nodiscard]] const StudyNumbers& numbers() const { return opened_.numbers; }
  /// Back to the camera and light that the window opened with.
  void resetView();
  [[nodiscard]] const cli::ViewRequest& request() const { return opened_.request; }
  [[nodiscard]] const PanePicture& pane(std::size_t index) const { return pictures_.pane(index); }
  /// Share of the truth that is traced for a pane, 0 to 1.
  [[nodiscard]] double tracedShare(std::size_t pane) const;
  /// What a pane would show, as answers; null for a difference or the displaced surface, and for
  /// what is not there yet. Valid until the next update.
  [[nodiscard]] const Answers* answersOf(const PaneContent& content);
  [[nodiscard]] WorkStatus baking() const { return baker_.status(); }
  [[nodiscard]] WorkStatus tracing() const { return tracer_.status(); }
  /// What stands in the way, one a line: shaders that do not compile, keys out of range.
  [[nodiscard]] std::vector<std::string> errors() const;
  /// Labels of all methods, the study's own first.
  [[nodiscard]] const std::vector<std::string>& labels() const { return opened_.labels; }
  /// The pixels of the study's base mesh, and the curvature there, once the camera rests.
  [[nodiscard]] const surface::SampleGrid* samples() const;
  [[nodiscard]] const std::shared_ptr<const CurvaturePicture>& curvature() const {
    return curvature_;
  }
  [[nodiscard]] const TracedMesh* traced() const { return traced_.get(); }
  [[nodiscard]] std::uint64_t serial() const { return serial_; }
  /// The options that read the study as it is shown, sliders included.
  [[nodiscard]] study::StudyOptions shownOptions() const;

 private:
  using Clock = std::chrono::steady_clock;
  using Baker = BackgroundWorker<SceneRequest, SceneResult>;

  void askForScene();
  void takeScenes();
  void takeTruths();
  void noticeChanges();
  void askForTruth();
  void forgetTruth(bool cameraMoved);
  void reloadShaders();
  [[nodiscard]] std::vector<AnglesRequest> missingAngles() const;

  OpenedStudy opened_;
  std::filesystem::path shaders_;
  ViewState state_;
  DrawnScene scene_;
  PanePictures pictures_;
  ShaderWatch watch_;
  std::string shaderError_, sceneError_, truthError_;

  std::string askedScene_;  ///< what the last scene was asked with
  int shaderVersion_ = 0;
  bool sceneArrives_ = true;  ///< one was asked for and is not there yet

  std::uint64_t serial_ = 0;
  Camera shownCamera_;
  LightAngles shownLight_;
  Clock::time_point cameraMoved_;

  KnownTruth truth_;
  std::map<study::MeshChoice, std::shared_ptr<const surface::SampleGrid>>
      grids_;  ///< of the camera at rest
  std::shared_ptr<const CurvaturePicture> curvature_;
  std::shared_ptr<const TracedMesh> traced_;
  std::string askedTruth_;
  bool pictureWhole_ = false;
  bool curvatureWhole_ = false;

  Baker baker_;  // last: their threads end first
  BackgroundWorker<TruthRequest, TruthResult> tracer_;
};

}  // namespace gnomon::app
