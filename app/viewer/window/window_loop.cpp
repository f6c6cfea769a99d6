#include "viewer/window/window_loop.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>

#include "common/error.h"
#include "common/lists.h"
#include "viewer/session/first_view.h"
#include "viewer/window/saved_view.h"

namespace gnomon::app {
namespace {

double secondsNow() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

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

std::unique_ptr<ShownStudy> firstStudy(const cli::ViewRequest& request) {
  const OpenedStudy opened = openStudy(request);
  return std::make_unique<ShownStudy>(opened, firstView(opened));
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
      status_(request.status),
      opener_([] { Window::wake(); }),
      shown_(firstStudy(request)) {}

PanelFacts WindowLoop::facts() const {
  const std::string opening =
      next_ ? next_->session.request().study.filename().string() : opener_.opening();
  const std::string note = recording_ ? recording_->progress() : filmNote(hasFilms_);
  return {frames_,
          shown_->others,
          opening,
          asksForPath_,
          shown_->history.canUndo(),
          shown_->history.canRedo(),
          {playedSince_.has_value(), isRecording(), note}};
}

/// While a recording takes its pictures nothing else may change: keys only end it.
Actions WindowLoop::readKeys(std::span<const int> keys) {
  if (!isRecording()) {
    return shown_->input.apply(shown_->session, shown_->screen.layout(), keys);
  }
  Actions actions;
  actions.record = contains(keys, GLFW_KEY_ESCAPE);
  actions.close = contains(keys, GLFW_KEY_Q);
  return actions;
}

/// Plays the path, or lights the frame that is to be recorded.
void WindowLoop::moveLight() {
  ViewState& state = shown_->session.state();
  if (isRecording()) {
    state.light = recording_->light();
  } else if (playedSince_) {
    const LightPath& path = state.path;
    const auto frame = frameAt(path, secondsNow() - *playedSince_);
    state.light =
        lightAt(path, frame.value_or(isClosed(path) ? 0 : path.frames - 1), state.light.radius);
    if (!frame) playedSince_.reset();
  }
}

Actions WindowLoop::drawFrame(std::span<const int> keys) {
  ViewSession& session = shown_->session;
  Screen& screen = shown_->screen;
  size_ = window_.size();
  screen.arrange(session, size_.width, size_.height);
  gui_.beginInWindow();
  if (!keys.empty() || isClicked()) notice_ = {};
  Actions actions = readKeys(keys);
  moveLight();
  screen.arrange(session, size_.width, size_.height);
  const bool isDrawn = session.update();
  const PanelFacts facts = this->facts();
  actions += screen.describe(session, facts, notice_, shown_->input.activePane());
  asksForPath_ = false;
  act(actions);
  record(facts.path.isRecording);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  gui_.draw(size_.width, size_.height);
  window_.swap();
  frames_.end(isDrawn);
  status_.write(session, screen.places(), facts, notice_);
  if (isDrawn || !keys.empty() || gui_.hasInput()) restlessFrames_ = 3;
  return actions;
}

void WindowLoop::save(const Actions& actions) {
  ViewSession& session = shown_->session;
  if (actions.savePicture) {
    notice_ =
        noticeOf([&] { return savePicture(session, pictureOf(gui_, size_.width, size_.height)); });
  }
  if (actions.saveStudy) notice_ = noticeOf([&] { return saveStudyView(session); });
  if (actions.saveMasks) notice_ = noticeOf([&] { return saveMasks(session); });
}

void WindowLoop::act(const Actions& actions) {
  ViewState& state = shown_->session.state();
  save(actions);
  noticeSteps();
  if (actions.undo) restore(shown_->history.undo(), state);
  if (actions.redo) restore(shown_->history.redo(), state);
  if (actions.askForStudy) asksForPath_ = state.panel = true;
  if (actions.open) opener_.open(*actions.open, shown_->session.request());
  if (actions.play) playedSince_ = playedSince_ ? std::nullopt : std::optional(secondsNow());
  if (!actions.record) return;
  if (isRecording()) {
    stopRecording({recording_->outcome() + "; the path was not recorded to its end", false});
  } else if (!recording_) {
    playedSince_.reset();
    lightBefore_ = state.light;
    notice_ = noticeOf([&]() -> std::string {
      recording_.emplace(state.path, state.light.radius, freeRecordingFolder(shown_->session));
      return "";
    });
  }
}

/// Takes the picture that is wanted, once the truth under its light is whole.
void WindowLoop::record(bool isDescribed) {
  if (!recording_) return;
  ViewSession& session = shown_->session;
  if (!isRecording()) {
    if (recording_->isDone()) {
      notice_ = {recording_->outcome(), false};
      recording_.reset();
    }
    return;
  }
  const std::vector<std::string> errors = session.errors();
  if (!errors.empty()) return stopRecording({errors.front(), true});
  if (!isDescribed || !session.isComplete()) return;
  try {
    recording_->add(
        cutOut(pictureOf(gui_, size_.width, size_.height), shown_->screen.layout().pictures));
  } catch (const Error& error) {
    return stopRecording({error.what(), true});
  }
  restlessFrames_ = 3;
  if (!isRecording()) session.state().light = lightBefore_;
}

void WindowLoop::stopRecording(const Notice& notice) {
  recording_.reset();
  shown_->session.state().light = lightBefore_;
  notice_ = notice;
}

void WindowLoop::noticeSteps() {
  const bool isHeld =
      shown_->input.isDragging() || ImGui::IsAnyItemActive() || playedSince_ || isRecording();
  shown_->history.observe(choiceOf(shown_->session.state()), secondsNow(), isHeld);
}

/// Another study takes the place of this one when it has something to show; one that has not is
/// told, and this one stays.
void WindowLoop::takeStudy() {
  if (auto answer = opener_.take()) {
    if (answer->study) {
      next_ = std::make_unique<ShownStudy>(*answer->study,
                                           nextView(*answer->study, shown_->session.state()));
    } else {
      notice_ = {answer->error, true};
    }
    restlessFrames_ = 3;
  }
  if (!next_ || isRecording()) return;
  ViewSession& session = next_->session;
  next_->screen.arrange(session, size_.width, size_.height);
  session.update();
  const std::vector<std::string> errors = session.errors();
  if (session.hasScene()) {
    shown_ = std::move(next_);
    playedSince_.reset();
    restlessFrames_ = 3;
  } else if (!errors.empty()) {
    notice_ = {errors.front(), true};
    next_.reset();
    restlessFrames_ = 3;
  }
}

/// How long the window may wait for input, seconds. Dear ImGui answers to input within a few
/// frames.
double WindowLoop::pause() const {
  constexpr double rest = 0.1;
  constexpr double playing = 0.5 / pathFramesPerSecond;
  if (restlessFrames_ > 0) return 0;
  return playedSince_ ? playing : rest;
}

void WindowLoop::run() {
  window_.show();
  while (!window_.wantsToClose()) {
    window_.readInput(pause());
    restlessFrames_ = std::max(0, restlessFrames_ - 1);
    const std::vector<int> keys = window_.takeKeys();
    frames_.begin();
    const Actions actions = drawFrame(keys);
    takeStudy();
    if (actions.close) break;
  }
}

}  // namespace gnomon::app
