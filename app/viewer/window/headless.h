#pragma once

#include "cli/commands/view_request.h"

namespace gnomon::app {

/// Renders the window's content without a display, the truth whole.
/// @throws as openViewer
void takeScreenshot(const cli::ViewRequest& request);

/// Records the light path without a display, and says what is there.
/// @throws as openViewer
void recordPath(const cli::ViewRequest& request);

}  // namespace gnomon::app
