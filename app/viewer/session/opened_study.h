#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands/view_command.h"
#include "study/spec/study_file.h"

namespace gnomon::app {

/// What the file has of keys that sliders move, and StudySpec does not keep; unset where the file
/// has no such key.
struct StudyNumbers {
  std::optional<double> height;     ///< `relief.height`
  std::optional<double> curvature;  ///< `surface.curvature`
};

/// A study as it was read for the viewer, before any slider.
struct OpenedStudy {
  cli::ViewRequest request;  ///< with all built-in methods after the study's own
  std::shared_ptr<const study::StudySpec> study;
  StudyNumbers numbers;
  std::vector<std::string> labels;  ///< of all methods that can be shown, the study's own first
  std::size_t ownCount = 0;         ///< how many of them are the study's own
};

/// Reads the study of a request. Needs no context, so any thread may call it.
/// @throws InputError as readStudy
OpenedStudy openStudy(const cli::ViewRequest& request);

}  // namespace gnomon::app
