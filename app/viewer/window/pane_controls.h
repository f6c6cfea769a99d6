#pragma once

#include "viewer/session/view_session.h"
#include "viewer/window/control_widgets.h"

namespace gnomon::app {

/// How many panes there are, and what each of them shows.
void drawPaneControls(ViewSession& session, ControlWidgets& widgets);

/// What is drawn over the pictures.
void drawOverlayControls(ViewState& state, ControlWidgets& widgets);

}  // namespace gnomon::app
