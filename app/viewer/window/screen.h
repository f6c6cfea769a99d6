#pragma once

#include "image/image.h"
#include "viewer/panes/gui.h"
#include "viewer/panes/pane_labels.h"
#include "viewer/panes/section_panel.h"
#include "viewer/window/controls.h"
#include "viewer/window/messages.h"

namespace gnomon::app {

/// Everything that a frame draws, the same in a window and without one.
class Screen {
 public:
  /// Puts the panes where the window has room for them.
  void arrange(ViewSession& session, int width, int height);

  /// Describes the frame to Dear ImGui.
  /// @param activePane  the one that keys speak of
  Actions describe(ViewSession& session, const PanelFacts& facts, const Notice& notice,
                   int activePane);

  [[nodiscard]] const WindowLayout& layout() const { return layout_; }
  [[nodiscard]] const ControlPlaces& places() const { return controls_.places(); }

 private:
  WindowLayout layout_;
  PaneView panes_;
  SectionPanel section_;
  PixelProbe probe_;
  ControlPanel controls_;
};

/// The frame that Dear ImGui describes, drawn by itself: a window's own pixels may lack the alpha
/// and round what is blended another way, and a picture must not depend on the window.
image::Image pictureOf(const Gui& gui, int width, int height);

/// The part of such a picture that a rectangle of the window holds.
image::Image cutOut(const image::Image& picture, const PaneRectangle& rectangle);

}  // namespace gnomon::app
