#include "viewer/window/window_loop.h"

#include <backends/imgui_impl_glfw.h>
#include <epoxy/gl.h>

#include <algorithm>

#include "common/error.h"
#include "viewer/window/saved_view.h"

namespace gnomon::app {
namespace {

/// What came of it; what went wrong is an answer, too.
template <typename Save>
Notice noticeOf(const Save& save) {
  try {
    return {save(), false};
  } catch (const Error& error) {
    return {error.what(), true};
  }
}

bool isClicked() {
  const auto& clicked = ImGui::GetIO().MouseClicked;
  return std::any_of(std::begin(clicked), std::end(clicked), [](bool now) { return now; });
}

}  // namespace

WindowLoop::Backend::Backend(const Window& window) {
  ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
}

WindowLoop::Backend::~Backend() {
  ImGui_ImplGlfw_Shutdown();
}

WindowLoop::WindowLoop(const cli::ViewRequest& request)
    : window_(request.width, request.height, "Gnomon"),
      backend_(window_),
      session_(request, [] { Window::wake(); }) {}

Actions WindowLoop::drawFrame(std::span<const int> keys) {
  size_ = window_.size();
  screen_.arrange(session_, size_.width, size_.height);
  gui_.beginInWindow();
  if (!keys.empty() || isClicked()) notice_ = {};
  Actions actions = input_.apply(session_, screen_.layout(), keys);
  screen_.arrange(session_, size_.width, size_.height);
  const bool isDrawn = session_.update();
  actions += screen_.describe(session_, frames_, notice_, input_.activePane());
  save(actions);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  gui_.draw(size_.width, size_.height);
  window_.swap();
  frames_.end(isDrawn);
  if (isDrawn || !keys.empty() || gui_.hasInput()) restlessFrames_ = 3;
  return actions;
}

void WindowLoop::save(const Actions& actions) {
  if (actions.savePicture) {
    notice_ =
        noticeOf([&] { return savePicture(session_, pictureOf(gui_, size_.width, size_.height)); });
  }
  if (actions.saveStudy) notice_ = noticeOf([&] { return saveStudyView(session_); });
  if (actions.saveMasks) notice_ = noticeOf([&] { return saveMasks(session_); });
}

/// How long the window may wait for input, seconds. Dear ImGui answers to input within a few
/// frames.
double WindowLoop::pause() const {
  constexpr double rest = 0.1;
  return restlessFrames_ > 0 ? 0 : rest;
}

void WindowLoop::run() {
  window_.show();
  while (!window_.wantsToClose()) {
    window_.readInput(pause());
    restlessFrames_ = std::max(0, restlessFrames_ - 1);
    const std::vector<int> keys = window_.takeKeys();
    frames_.begin();
    if (drawFrame(keys).close) break;
  }
}

}  // namespace gnomon::app
