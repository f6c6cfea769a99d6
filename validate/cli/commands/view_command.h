#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/error.h"
#include "study/run/method_trial.h"
#include "study/spec/study_file.h"

namespace gnomon::cli {

/// What `gnomon view` was asked for.
struct ViewRequest {
  std::filesystem::path study;
  study::StudyOptions options;
  std::filesystem::path out = "out";  ///< what is saved goes to `out/NAME/view`
  int width = 1280;                   ///< of the window, pixels
  int height = 720;
  /// What the panes show, "onoue-2004", "truth", "displaced" or "onoue-2004:truth": one, two or
  /// four; empty for the study's first method beside the truth.
  std::vector<std::string> show;
  std::vector<std::string> overlays;  ///< "curvature", "directions", "section", "pixel"
  bool panel = true;                  ///< the controls are shown
  bool help = false;                  ///< and the list of keys
  std::vector<int> cursor;  ///< x and y of the cursor without a display, pixels; empty for none
  /// Left, top, right and bottom of the rectangle whose error is told, percent of the picture;
  /// empty for none.
  std::vector<double> rectangle;
  /// The path of the light to record: "around" from the first light, or azimuth and elevation of
  /// its start and its end, degrees, "165,24,20,60".
  std::string lightPath = "around";
  int lightFrames = 48;  ///< of that path
  /// Records the path into this new folder without a display, the truth of every frame whole, and
  /// leaves.
  std::optional<std::filesystem::path> record;
  /// Renders the window's content without a display once the truth is whole, and leaves.
  std::optional<std::filesystem::path> screenshot;
  bool frames = false;  ///< print the times of frames at the end
  /// Tries a method in a process of its own before it is compiled, each time that its file is
  /// another; throws InputError for one that may not be.
  study::MethodTrial tryMethod;
};

/// Shows a study until its window is closed. The program hands one in, so that the library needs no
/// window system.
using Viewer = std::function<ExitStatus(const ViewRequest&)>;

}  // namespace gnomon::cli

namespace CLI {
class App;
}

namespace gnomon::cli {

/// Adds `gnomon view` and its options; they fill `request`.
CLI::App* addViewCommand(CLI::App& app, ViewRequest& request);

}  // namespace gnomon::cli
