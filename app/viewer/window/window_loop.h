#pragma once

#include <span>

#include "viewer/panes/gui.h"
#include "viewer/session/view_session.h"
#include "viewer/window/input.h"
#include "viewer/window/screen.h"
#include "viewer/window/window.h"

namespace gnomon::app {

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
  void save(const Actions& actions);
  [[nodiscard]] double pause() const;

  Window window_;
  Gui gui_;
  Backend backend_;
  FrameLog frames_;
  ViewSession session_;
  Screen screen_;
  Input input_;
  Window::Size size_{};
  Notice notice_;
  int restlessFrames_ = 0;
};

}  // namespace gnomon::app
