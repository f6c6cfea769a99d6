#pragma once

#include <array>

#include "model/picking.h"

namespace gnomon {

/// Where things are in the window, pixels, y downward.
struct WindowLayout {
  PaneRectangle panel;                 ///< the controls; without size where they are hidden
  PaneRectangle pictures;              ///< all panes together
  std::array<PaneRectangle, 4> panes;  ///< of two, both are all of `pictures`
  int paneCount = 1;
};

/// @param paneCount  1, 2 or 4
WindowLayout windowLayout(int width, int height, bool panel, int paneCount);

/// The pane under a place of the window; -1 for none.
/// @param wipe  where the second of two panes begins, share of the width
int paneUnder(const WindowLayout& layout, Vec2 place, double wipe);

}  // namespace gnomon
