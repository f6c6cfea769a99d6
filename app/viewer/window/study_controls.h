#pragma once

#include "viewer/session/view_session.h"
#include "viewer/window/control_widgets.h"

namespace gnomon::app {

/// The sliders of the bumps and of the meshes.
void drawSurfaceControls(ViewSession& session, ControlWidgets& widgets);

/// The sliders of the tables that methods read, and how far their bake is.
void drawTableControls(ViewSession& session, ControlWidgets& widgets);

/// The parameters of the methods that are shown.
void drawParameterControls(ViewSession& session, ControlWidgets& widgets);

/// A bar that shows how far a computation is.
void drawProgress(const WorkStatus& work, const char* idle);

}  // namespace gnomon::app
