#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/exception.h"

namespace gnomon {
inline namespace api {

struct RunOptions {
  std::filesystem::path out = "out";  ///< results go to `out/NAME`
  std::vector<std::string> methods;   ///< labels or names to keep; all, if empty
  std::vector<std::string> settings;  ///< overrides of the study's keys, "relief.height=4"
  bool quick = false;  ///< a quarter of each view's side, a sixteenth of the mesh: a preview
  bool cache = true;   ///< take what earlier runs left in the user's cache, and leave this one's
  /// Told which stage runs and what share of it is done, 0 to 1, from any thread but never from two
  /// at once. What it throws cancels the run and comes out of `runStudy`.
  std::function<void(std::string_view stage, double share)> progress;
};

struct RunResult {
  std::filesystem::path summary;  ///< summary.json; the other results lie beside it
  bool passed = false;  ///< every [[threshold]] of the study holds and every method was measured
  std::vector<std::string> failures;  ///< a line for each threshold or method for which this fails
};

/// Measures a study or sweep as `gnomon run` does and writes its folder. The work is done on a
/// thread of its own: the caller's OpenGL context is not touched.
/// @throws Exception  badInput naming file, line and key, or for a folder that holds somebody
/// else's
///   results; noOpenGl; internal
GNOMON_API RunResult runStudy(const std::filesystem::path& study, const RunOptions& options = {});

}  // namespace api
}  // namespace gnomon
