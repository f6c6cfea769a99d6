#pragma once

#include <memory>
#include <optional>
#include <span>

#include "model/history.h"
#include "viewer/panes/gui.h"
#include "viewer/session/study_opener.h"
#include "viewer/session/view_session.h"
#include "viewer/window/input.h"
#include "viewer/window/path_recording.h"
#include "viewer/window/screen.h"
#include "viewer/window/status_file.h"
#include "viewer/window/window.h"

namespace gnomon::app {

/// An open study, and what goes with it when another is opened.
struct ShownStudy {
  ShownStudy(const OpenedStudy& opened, const ViewState& state)
      : session(opened, state, [] { Window::wake(); }),
        history(choiceOf(state)),
        others(studiesBeside(opened.request)) {}

  ViewSession session;
  Screen screen;
  Input input;
  History<ViewChoice> history;
  std::vector<std::filesystem::path> others;  ///< studies to choose from
};

/// The window from its opening to its end: reads input, brings the session up to date, draws, and
/// does what was asked for.
class WindowLoop {
 public:
  /// @throws NoGlError, InputError, UsageError as openViewer
  explicit WindowLoop(const cli::ViewRequest& request);
  void run();
  [[nodiscard]] const FrameLog& frames() const { return frames_; }

 private:
  /// Dear ImGui's part in a window.
  class Backend {
   public:
    explicit Backend(const Window& window);
    Backend(const Backend&) = delete;
    Backend& operator=(const Backend&) = delete;
    ~Backend();
  };

  /// @return what was asked for
  Actions drawFrame(std::span<const int> keys);
  [[nodiscard]] Actions readKeys(std::span<const int> keys);
  [[nodiscard]] PanelFacts facts() const;
  void act(const Actions& actions);
  void save(const Actions& actions);
  void moveLight();
  /// @param isDescribed  the frame shows what a recording is to have
  void record(bool isDescribed);
  void stopRecording(const Notice& notice);
  void noticeSteps();
  void takeStudy();
  [[nodiscard]] bool isRecording() const { return recording_ && !recording_->hasAllFrames(); }
  [[nodiscard]] double pause() const;

  Window window_;
  Gui gui_;
  Backend backend_;
  FrameLog frames_;
  StatusFile status_;
  StudyOpener opener_;
  std::unique_ptr<ShownStudy> shown_;
  std::unique_ptr<ShownStudy> next_;  ///< takes its place once it has something to show
  Window::Size size_{};
  Notice notice_;
  std::optional<double> playedSince_;
  std::optional<PathRecording> recording_;
  const bool hasFilms_ = hasFfmpeg();
  LightAngles lightBefore_;  ///< where a recording began
  bool asksForPath_ = false;
  int restlessFrames_ = 0;
};

}  // namespace gnomon::app
