#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/commands/view_request.h"
#include "viewer/session/view_state.h"

namespace gnomon::app {

/// What the window opens with.

/// The request's options, with all built-in methods after the study's own.
/// @throws InputError as parseToml
study::StudyOptions optionsOf(const cli::ViewRequest& request);

/// What the file has of keys that sliders move, and StudySpec does not keep; unset where the file
/// has no such key.
struct StudyNumbers {
  std::optional<double> height;     ///< `relief.height`
  std::optional<double> curvature;  ///< `surface.curvature`
};

StudyNumbers numbersOf(const cli::ViewRequest& request);

/// The labels of a study's methods, in its order.
std::vector<std::string> labelsOf(const study::StudySpec& study);

/// The study's first camera (or one that sees all of the surface), its first light, and the panes
/// and overlays that are asked for.
/// @throws UsageError for contents that are none, or other than one, two or four of them
ViewState firstView(const study::StudySpec& study, const cli::ViewRequest& request,
                    const std::vector<std::string>& labels);

}  // namespace gnomon::app
