#include "viewer/window/open_viewer.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <epoxy/gl.h>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <thread>

#include "common/error.h"
#include "image/images.h"
#include "render/gl_context.h"
#include "render/target.h"
#include "viewer/panes/gui.h"
#include "viewer/panes/pane_labels.h"
#include "viewer/panes/section_panel.h"
#include "viewer/window/controls.h"
#include "viewer/window/input.h"
#include "viewer/window/saved_view.h"
#include "viewer/window/status_file.h"
#include "viewer/window/window.h"

namespace gnomon::app {
namespace {

/// Everything that a frame draws, the same in a window and without one.
class Screen {
 public:
  explicit Screen(ViewSession& session) : session_(session) {}

  /// Puts the panes where the window has room for them.
  void arrange(int width, int height) {
    ViewState& state = session_.state();
    layout_ = windowLayout(width, height, {state.panel, state.overlays.section, state.paneCount});
    state.camera.width = static_cast<int>(layout_.panes.front().size.x);
    state.camera.height = static_cast<int>(layout_.panes.front().size.y);
  }

  /// Describes the frame to Dear ImGui.
  SaveActions describe(const FrameLog& frames, const std::string& said, int activePane) {
    const ImVec2 cursor = ImGui::GetIO().MousePos;
    const Overlays& overlays = session_.state().overlays;
    if (session_.hasScene()) panes_.draw(session_, layout_, activePane);
    drawWaiting(session_, layout_);
    if (overlays.section) section_.draw(session_, layout_, {cursor.x, cursor.y});
    if (overlays.pixel) drawPixelText(session_, probe_, layout_, {cursor.x, cursor.y});
    SaveActions actions;
    if (session_.state().panel) {
      actions = controls_.draw(session_, layout_.panel, frames, said);
    }
    drawErrors(session_, layout_);
    if (session_.state().help) drawKeyList(layout_);
    return actions;
  }

  [[nodiscard]] const WindowLayout& layout() const { return layout_; }
  [[nodiscard]] const ControlPanel& controls() const { return controls_; }

 private:
  ViewSession& session_;
  WindowLayout layout_;
  PaneView panes_;
  SectionPanel section_;
  PixelProbe probe_;
  ControlPanel controls_;
};

SaveActions both(const SaveActions& a, const SaveActions& b) {
  return {a.study || b.study, a.screenshot || b.screenshot, a.masks || b.masks};
}

/// The frame that Dear ImGui describes, drawn by itself: a window's own pixels may lack the alpha
/// and round what is blended another way, and a picture must not depend on the window.
image::Image pictureOf(const Gui& gui, int width, int height) {
  const render::Target target(width, height, {GL_RGBA8});
  target.bind();
  gui.draw(width, height);
  return {width, height, target.read<std::uint8_t>(0, GL_RGB, GL_UNSIGNED_BYTE, 3)};
}

/// Dear ImGui's part in a window.
class WindowInput {
 public:
  explicit WindowInput(const Window& window) {
    ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
  }
  WindowInput(const WindowInput&) = delete;
  WindowInput& operator=(const WindowInput&) = delete;
  ~WindowInput() { ImGui_ImplGlfw_Shutdown(); }
};

/// The answer to what was saved; what went wrong is an answer, too.
template <typename Save>
std::string answerOf(const Save& save) {
  try {
    return save();
  } catch (const Error& error) {
    return error.what();
  }
}

void runWindow(const cli::ViewRequest& request) {
  Window window(request.width, request.height, "Gnomon");
  const Gui gui;
  const WindowInput windowInput(window);
  ViewSession session(request, [] { Window::wake(); });
  Screen screen(session);
  Input input;
  FrameLog frames;
  StatusFile status(request.status);
  std::string said;
  int restlessFrames = 0;
  window.show();
  while (!window.wantsToClose()) {
    // Dear ImGui answers to input within a few frames; then there is time to wait.
    constexpr double pause = 0.1;
    window.readInput(restlessFrames > 0 ? 0 : pause);
    const std::vector<int> keys = window.takeKeys();
    frames.begin();
    const auto [width, height] = window.size();
    screen.arrange(width, height);
    gui.beginInWindow();
    const InputActions asked = input.apply(session, screen.layout(), keys);
    screen.arrange(width, height);
    const bool drawn = session.update();
    const SaveActions pressed = screen.describe(frames, said, input.activePane());
    const SaveActions save = both(asked.save, pressed);
    if (save.screenshot) {
      // Clang 14 captures no structured bindings by reference.
      said = answerOf(
          [&, w = width, h = height] { return savePicture(session, pictureOf(gui, w, h)); });
    }
    if (save.study) said = answerOf([&] { return saveStudyView(session); });
    if (save.masks) said = answerOf([&] { return saveMasks(session); });
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    gui.draw(width, height);
    window.swap();
    frames.end(drawn);
    status.write(session, screen.controls().places(), frames, said);
    if (asked.close) break;
    restlessFrames = drawn || !keys.empty() || gui.hasInput() ? 3 : std::max(0, restlessFrames - 1);
  }
  if (request.frames) fmt::print("{}\n", frames.text());
}

void takeScreenshot(const cli::ViewRequest& request) {
  const render::GlContext context;
  const Gui gui;
  ViewSession session(request, [] {});
  Screen screen(session);
  FrameLog frames;
  constexpr float nowhere = -std::numeric_limits<float>::max();
  const ImVec2 cursor = request.cursor.size() == 2 ? ImVec2(static_cast<float>(request.cursor[0]),
                                                            static_cast<float>(request.cursor[1]))
                                                   : ImVec2(nowhere, nowhere);
  screen.arrange(request.width, request.height);
  while (true) {
    session.update();
    if (!session.hasScene() && !session.errors().empty()) {
      throw InputError(session.errors().front());
    }
    if (session.isComplete()) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  session.update();
  const int under = paneUnder(screen.layout(), {cursor.x, cursor.y}, session.state().wipe);
  image::Image picture;
  // Twice: Dear ImGui knows the size of some things only in the second frame.
  for (int frame = 0; frame < 2; ++frame) {
    gui.beginWithoutWindow(request.width, request.height, cursor);
    screen.describe(frames, {}, std::max(0, under));
    picture = pictureOf(gui, request.width, request.height);
  }
  image::writePng(*request.screenshot, picture);
  StatusFile(request.status).write(session, screen.controls().places(), frames, {});
}

}  // namespace

ExitStatus openViewer(const cli::ViewRequest& request) {
  if (request.screenshot) {
    takeScreenshot(request);
  } else {
    runWindow(request);
  }
  return ExitStatus::pass;
}

}  // namespace gnomon::app
