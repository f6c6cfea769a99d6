#pragma once

#include <string>
#include <vector>

#include "viewer/panes/layout.h"
#include "viewer/session/view_session.h"
#include "viewer/window/actions.h"
#include "viewer/window/control_widgets.h"
#include "viewer/window/frame_log.h"
#include "viewer/window/light_controls.h"

namespace gnomon::app {

/// What the panel shows that is no part of the session.
struct PanelFacts {
  const FrameLog& frames;
  std::vector<std::filesystem::path> studies = {};  ///< to choose from, the open one among them
  std::string opening = {};                         ///< that is being read; empty for none
  bool asksForPath = false;  ///< the field for a study's path gets the keyboard
  bool canUndo = false, canRedo = false;
  PathStatus path = {};
};

/// The panel beside the pictures. Changes the session's state, never anything else.
class ControlPanel {
 public:
  Actions draw(ViewSession& session, const PaneRectangle& place, const PanelFacts& facts);

  [[nodiscard]] const ControlPlaces& places() const { return widgets_.places(); }

 private:
  Actions study(const ViewSession& session, const PanelFacts& facts);
  Actions steps(const PanelFacts& facts);
  Actions saving();
  void truth(const ViewSession& session);

  ControlWidgets widgets_;
  std::string path_;  ///< as it stands in the field
};

}  // namespace gnomon::app
