#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "viewer/panes/layout.h"
#include "viewer/session/view_session.h"
#include "viewer/window/frame_log.h"

namespace gnomon::app {

/// What a person asks to be written.
struct SaveActions {
  bool study = false;
  bool screenshot = false;
  bool masks = false;
};

/// Where a control is on the screen, window pixels: left, top, right, bottom.
using ControlPlaces = std::map<std::string, std::array<int, 4>>;

/// The panel beside the pictures. Changes the session's state, never anything else.
class ControlPanel {
 public:
  /// @param said  what the last action answered, shown under the buttons
  SaveActions draw(ViewSession& session, const PaneRectangle& place, const FrameLog& frames,
                   const std::string& said);

  [[nodiscard]] const ControlPlaces& places() const { return places_; }

 private:
  void panes(ViewSession& session);
  void paneChoice(ViewSession& session, std::size_t pane);
  void view(ViewSession& session);
  void light(ViewSession& session);
  void surface(ViewSession& session);
  void tables(ViewSession& session);
  void parameters(ViewSession& session);
  void overlays(ViewState& state);
  SaveActions saving(const std::string& said);
  void status(const ViewSession& session, const FrameLog& frames);

  /// Opens a drop-down, which Escape closes. To be ended by ImGui::EndCombo where it is open.
  bool openList(const char* label, const std::string& name, const std::string& shown);
  /// A drop-down of names, of which one may be chosen now.
  /// @return the place of the one that was pressed
  std::optional<std::size_t> list(const char* label, const std::string& name,
                                  const std::vector<std::string>& entries,
                                  std::optional<std::size_t> chosen);
  bool slider(const char* label, const std::string& name, double& value, double low, double high,
              const char* format);
  bool slider(const char* label, const std::string& name, int& value, int low, int high);
  /// Keeps in mind where the control is that was just drawn.
  void note(const std::string& name);

  ControlPlaces places_;
};

/// A box over the pictures with everything that stands in the way; nothing where nothing does.
void drawErrors(const ViewSession& session, const WindowLayout& layout);

/// What is still missing before there is a first picture.
void drawWaiting(const ViewSession& session, const WindowLayout& layout);

}  // namespace gnomon::app
