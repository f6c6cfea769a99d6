#include "viewer/window/open_viewer.h"

#include <fmt/core.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <limits>
#include <memory>
#include <thread>
#include <vector>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "common/system/process.h"
#include "common/text.h"
#include "image/images.h"
#include "model/light_angles.h"
#include "render/gl_context.h"
#include "viewer/panes/gui.h"
#include "viewer/window/screen.h"
#include "viewer/window/window_loop.h"

namespace gnomon::app {
namespace fs = std::filesystem;
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
  [[nodiscard]] const WindowLayout& layout() const { return screen_.layout(); }

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

  /// All of the window.
  image::Image picture(ImVec2 cursor) {
    const int under = paneUnder(layout(), {cursor.x, cursor.y}, session_.state().wipe);
    return drawn(cursor, [&] { screen_.describe(session_, {}, {}, std::max(0, under)); });
  }
  /// The window without panel, messages and marks.
  image::Image panes() {
    return drawn({nowhere, nowhere}, [&] { screen_.describePanes(session_); });
  }

 private:
  template <typename Describe>
  image::Image drawn(ImVec2 cursor, const Describe& describe) {
    image::Image picture;
    // Twice: Dear ImGui knows the size of some things only in the second frame.
    for (int frame = 0; frame < 2; ++frame) {
      gui_.beginWithoutWindow(request_.width, request_.height, cursor);
      describe();
      picture = pictureOf(gui_, request_.width, request_.height);
    }
    return picture;
  }

  const cli::ViewRequest& request_;
  render::GlContext context_;
  Gui gui_;
  ViewSession session_;
  Screen screen_;
};

/// The part of a picture that a rectangle of the window holds.
image::Image cutOut(const image::Image& picture, const PaneRectangle& rectangle) {
  const auto at = [](double place, int end) { return std::clamp(static_cast<int>(place), 0, end); };
  const int left = at(rectangle.corner.x, picture.width);
  const int top = at(rectangle.corner.y, picture.height);
  const int right = at(rectangle.corner.x + rectangle.size.x, picture.width);
  const int bottom = at(rectangle.corner.y + rectangle.size.y, picture.height);
  image::Image part{right - left, bottom - top, {}};
  for (int row = top; row < bottom; ++row) {
    const auto line = picture.rgb.begin() + 3 * static_cast<std::ptrdiff_t>(row) * picture.width;
    part.rgb.insert(part.rgb.end(), line + 3 * left, line + 3 * right);
  }
  return part;
}

/// Pictures of two recordings must not be mixed in one film.
void makeEmptyFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && fs::is_empty(folder, error)) return;
  throw InputError(
      error ? fmt::format("{}: cannot create the folder: {}", folder.string(), error.message())
            : fmt::format("{}: holds files, a new or an empty folder expected", folder.string()));
}

constexpr const char* filmName = "light.webm";
constexpr const char* filmFramesPerSecond = "12";

/// Makes a WebM film with VP9 of a folder's pictures where the program `ffmpeg` is installed, which
/// the viewer needs for nothing else. The film is there whole, or not at all.
/// @return why there is none; empty where there is one
std::string makeFilm(const fs::path& folder) {
  PartFile file(folder, ".webm");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> messages(std::tmpfile(), &std::fclose);
  if (!messages) return fmt::format("no film: no temporary file: {}", std::strerror(errno));
  const ChildStart started = startChild({{"ffmpeg",
                                          "-nostdin",
                                          "-loglevel",
                                          "error",
                                          "-y",
                                          "-framerate",
                                          filmFramesPerSecond,
                                          "-i",
                                          "frame-%04d.png",
                                          "-c:v",
                                          "libvpx-vp9",
                                          "-crf",
                                          "24",
                                          "-b:v",
                                          "0",
                                          "-pix_fmt",
                                          "yuv420p",
                                          "-f",
                                          "webm",
                                          "file:" + file.path().filename().string()},
                                         {},
                                         folder,
                                         nullptr,
                                         messages.get(),
                                         messages.get()});
  if (started.failure == ENOENT) return "no film, since ffmpeg was not found";
  if (started.failure != 0) {
    return fmt::format("no film: ffmpeg: {}", std::strerror(started.failure));
  }
  const int state = endOfChild(started.process, true).value_or(0);
  if (!WIFEXITED(state) || WEXITSTATUS(state) != 0) {
    std::string said = contentOf(messages.get());
    while (said.ends_with('\n')) said.pop_back();
    return "no film: ffmpeg: " + (said.empty() ? "it ended without a word" : oneLine(said));
  }
  if (fs::file_size(file.path()) == 0) return "no film: ffmpeg: it wrote nothing";
  syncFile(file.descriptor(), folder / filmName);
  file.nameIt(folder / filmName);
  return {};
}

/// Renders the window's content without a display, the truth whole.
void takeScreenshot(const cli::ViewRequest& request) {
  Headless viewer(request);
  viewer.complete();
  const ImVec2 cursor = request.cursor.size() == 2 ? ImVec2(static_cast<float>(request.cursor[0]),
                                                            static_cast<float>(request.cursor[1]))
                                                   : ImVec2(nowhere, nowhere);
  image::writePng(*request.screenshot, viewer.picture(cursor));
}

/// Records the panes along a path of the light without a display, the truth of every frame whole:
/// `frame-0001.png` and so on in a new folder, and `light.webm` where `ffmpeg` is installed. Says
/// what is there.
void recordPath(const cli::ViewRequest& request) {
  Headless viewer(request);
  LightAngles& light = viewer.session().state().light;
  const double radius = light.radius;
  const LightPath path = parsePath(request.lightPath, light, request.lightFrames);
  const fs::path& folder = *request.record;
  makeEmptyFolder(folder);
  for (int frame = 0; frame < path.frames; ++frame) {
    light = lightAt(path, frame, radius);
    viewer.complete();
    const std::vector<std::string> errors = viewer.session().errors();
    if (!errors.empty()) throw InputError(errors.front());
    image::writePng(folder / fmt::format("frame-{:04}.png", frame + 1),
                    cutOut(viewer.panes(), viewer.layout().pictures));
  }
  const std::string lacking = makeFilm(folder);
  fmt::print("saved {} {}{} in {}{}\n", path.frames, path.frames == 1 ? "picture" : "pictures",
             lacking.empty() ? fmt::format(" and {}", filmName) : "", folder.string(),
             lacking.empty() ? "" : "; " + lacking);
}

}  // namespace

ExitStatus openViewer(const cli::ViewRequest& request) {
  if (request.record) {
    recordPath(request);
  } else if (request.screenshot) {
    takeScreenshot(request);
  } else {
    WindowLoop loop(request);
    loop.run();
    if (request.frames) fmt::print("{}\n", loop.frames().text());
  }
  return ExitStatus::pass;
}

}  // namespace gnomon::app
