#pragma once

#include <string>

#include "image/images.h"
#include "viewer/panes/gui.h"
#include "viewer/panes/pane_labels.h"
#include "viewer/panes/section_panel.h"
#include "viewer/window/controls.h"

namespace gnomon::app {

/// The answer to what a person asked for last.
struct Notice {
  std::string text;  ///< empty for none
  bool isError = false;
};

/// Everything that a frame draws, the same in a window and without one.
class Screen {
 public:
  /// Puts the panes where the window has room for them.
  void arrange(ViewSession& session, int width, int height);

  /// Describes the frame to Dear ImGui.
  /// @param activePane  the one that keys speak of
  Actions describe(ViewSession& session, const FrameLog& frames, const Notice& notice,
                   int activePane);
  /// Describes the panes alone, as a film shows them.
  void describePanes(const ViewSession& session);

  [[nodiscard]] const WindowLayout& layout() const { return layout_; }

 private:
  WindowLayout layout_;
  PaneView panes_;
  SectionPanel section_;
  PixelProbe probe_;
};

/// The frame that Dear ImGui describes, drawn by itself: a window's own pixels may lack the alpha
/// and round what is blended another way, and a picture must not depend on the window.
image::Image pictureOf(const Gui& gui, int width, int height);

}  // namespace gnomon::app
