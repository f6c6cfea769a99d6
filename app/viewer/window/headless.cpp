#include "viewer/window/headless.h"

#include <fmt/core.h>

#include <chrono>
#include <limits>
#include <thread>

#include "common/error.h"
#include "image/images.h"
#include "render/gl_context.h"
#include "viewer/panes/gui.h"
#include "viewer/window/path_recording.h"
#include "viewer/window/screen.h"
#include "viewer/window/status_file.h"

namespace gnomon::app {
namespace {

constexpr auto pause = std::chrono::milliseconds(10);
constexpr float nowhere = -std::numeric_limits<float>::max();

/// The viewer where there is no window.
class Headless {
 public:
  explicit Headless(const cli::ViewRequest& request) : request_(request), session_(request, [] {}) {
    screen_.arrange(session_, request.width, request.height);
  }
  [[nodiscard]] ViewSession& session() { return session_; }
  [[nodiscard]] const Screen& screen() const { return screen_; }
  [[nodiscard]] const FrameLog& frames() const { return frames_; }

  /// Until all that the state asks for is there.
  void complete() {
    session_.update();
    while (!session_.isComplete()) {
      std::this_thread::sleep_for(pause);
      session_.update();
    }
    if (!session_.hasScene() && !session_.errors().empty()) {
      throw InputError(session_.errors().front());
    }
    session_.update();
  }

  image::Image picture(ImVec2 cursor, const PanelFacts& facts) {
    const int under = paneUnder(screen_.layout(), {cursor.x, cursor.y}, session_.state().wipe);
    image::Image picture;
    // Twice: Dear ImGui knows the size of some things only in the second frame.
    for (int frame = 0; frame < 2; ++frame) {
      gui_.beginWithoutWindow(request_.width, request_.height, cursor);
      screen_.describe(session_, facts, {}, std::max(0, under));
      picture = pictureOf(gui_, request_.width, request_.height);
    }
    return picture;
  }

 private:
  const cli::ViewRequest& request_;
  render::GlContext context_;
  Gui gui_;
  ViewSession session_;
  Screen screen_;
  FrameLog frames_;
};

}  // namespace

void takeScreenshot(const cli::ViewRequest& request) {
  Headless viewer(request);
  viewer.complete();
  const ImVec2 cursor = request.cursor.size() == 2 ? ImVec2(static_cast<float>(request.cursor[0]),
                                                            static_cast<float>(request.cursor[1]))
                                                   : ImVec2(nowhere, nowhere);
  PanelFacts facts{viewer.frames()};
  facts.path.note = filmNote(hasFfmpeg());
  image::writePng(*request.screenshot, viewer.picture(cursor, facts));
  StatusFile(request.status).write(viewer.session(), viewer.screen().places(), facts, {});
}

void recordPath(const cli::ViewRequest& request) {
  Headless viewer(request);
  ViewState& state = viewer.session().state();
  PathRecording recording(state.path, state.light.radius, *request.record);
  PanelFacts facts{viewer.frames()};
  facts.path.isRecording = true;
  while (!recording.hasAllFrames()) {
    state.light = recording.light();
    viewer.complete();
    const std::vector<std::string> errors = viewer.session().errors();
    if (!errors.empty()) throw InputError(errors.front());
    recording.add(
        cutOut(viewer.picture({nowhere, nowhere}, facts), viewer.screen().layout().pictures));
  }
  while (!recording.isDone()) std::this_thread::sleep_for(pause);
  fmt::print("{}\n", recording.outcome());
}

}  // namespace gnomon::app
