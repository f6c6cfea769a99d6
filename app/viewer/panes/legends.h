#pragma once

#include <imgui.h>

#include "model/picking.h"

namespace gnomon::app {

/// What the colours of pictures mean.

/// Of a difference, in a lower corner of its pane.
/// @param isSoft  it is one of shares, not of masks
void drawDifferenceLegend(ImDrawList& list, const PaneRectangle& pane, bool isSoft,
                          bool rightAligned);

/// Of the curvature, in the middle above the line in which the legends of differences stand.
/// @param largest  the curvature that the ends of the scale stand for, 1 / world
void drawCurvatureLegend(ImDrawList& list, const PaneRectangle& pictures, double largest);

}  // namespace gnomon::app
