#include "viewer/window/open_viewer.h"

#include <fmt/core.h>

#include "viewer/window/headless.h"
#include "viewer/window/window_loop.h"

namespace gnomon::app {

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
