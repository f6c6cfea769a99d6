#pragma once

#include <array>

#include "model/picking.h"

namespace gnomon::app {

/// What a window shows beside one pane.
struct WindowParts {
  bool panel = true;     ///< the controls
  bool section = false;  ///< the cross-section
  int paneCount = 1;     ///< 1, 2 or 4
};

/// Where things are in the window, pixels, y downward.
struct WindowLayout {
  PaneRectangle panel;                 ///< the controls; without size where they are hidden
  PaneRectangle section;               ///< the cross-section, below the pictures; likewise
  PaneRectangle pictures;              ///< all panes together
  std::array<PaneRectangle, 4> panes;  ///< of two, both are all of `pictures`
  int paneCount = 1;
};

WindowLayout windowLayout(int width, int height, const WindowParts& parts);

/// The pane under a place of the window; -1 for none.
/// @param wipe  where the second of two panes begins, share of the width
int paneUnder(const WindowLayout& layout, Vec2 place, double wipe);

}  // namespace gnomon::app
