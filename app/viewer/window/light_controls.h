#pragma once

#include "viewer/session/view_session.h"
#include "viewer/window/actions.h"
#include "viewer/window/control_widgets.h"

namespace gnomon::app {

/// What the light path is doing.
struct PathStatus {
  bool isPlaying = false;
  bool isRecording = false;  ///< pictures are being taken: nothing else may change
  std::string note;          ///< "frame 3 of 48", or whether a film can be made
};

/// Whether a recording makes a film, too.
inline std::string filmNote(bool hasFfmpeg) {
  return hasFfmpeg ? "with a film" : "no film: ffmpeg not found";
}

/// The study's cameras, where it has several.
void drawCameraControls(ViewSession& session, ControlWidgets& widgets);

/// The light: one of the study's, or any direction and size.
void drawLightControls(ViewSession& session, ControlWidgets& widgets);

/// The path of the light, to be played and recorded.
Actions drawPathControls(ViewSession& session, const PathStatus& status, ControlWidgets& widgets);

}  // namespace gnomon::app
