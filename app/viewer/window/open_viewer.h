#pragma once

#include "cli/commands/view_command.h"

namespace gnomon::app {

/// Shows a study in a window until it is closed; or, for a screenshot or a recording of the light,
/// renders without a display and leaves.
/// @throws NoGlError where there is no display or no OpenGL 4.5; InputError as readStudy, and for a
///   recording's folder that holds something; UsageError for contents, a rectangle or a path of the
///   light that are none
ExitStatus openViewer(const cli::ViewRequest& request);

}  // namespace gnomon::app
