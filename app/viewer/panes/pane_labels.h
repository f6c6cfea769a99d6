#pragma once

#include <imgui.h>

#include "model/picking.h"
#include "viewer/panes/layout.h"
#include "viewer/session/pixel_probe.h"
#include "viewer/session/view_session.h"

namespace gnomon::app {

/// What the colours of pictures mean.

/// Of a difference, in a lower corner of its pane.
/// @param isSoft  it is one of shares, not of masks
void drawDifferenceLegend(ImDrawList& list, const PaneRectangle& pane, bool isSoft,
                          bool rightAligned);

/// Of the curvature, in the middle above the line in which the legends of differences stand.
/// @param largest  the curvature that the ends of the scale stand for, 1 / world
void drawCurvatureLegend(ImDrawList& list, const PaneRectangle& pictures, double largest);

/// Draws the panes' pictures, overlays and labels behind all panels.
class PaneView {
 public:
  void draw(const ViewSession& session, const WindowLayout& layout, int activePane);

 private:
  void upload(const CurvaturePicture& picture);

  render::gl::Texture curvature_;
  int width_ = 0, height_ = 0;
  std::shared_ptr<const CurvaturePicture> shown_;  ///< what the texture holds
};

/// What is known of the pixel under the cursor, beside it; nothing off the surface.
void drawPixelText(ViewSession& session, PixelProbe& probe, const WindowLayout& layout,
                   Vec2 cursor);

/// "2.41 % wrong: 1.20 % false shadow, 1.21 % false light; shadow overlap (IoU) 0.873"; of shares
/// the mean of |ΔV|, "mean |ΔV| 2.41 %: …".
std::string figuresText(const PaneFigures& figures);

/// What is told of a rectangle: "1 234 samples, 56 wrong: 4.54 %", then "3.10 % false shadow,
/// 1.44 % false light"; of shares "1 234 samples, mean |ΔV| 4.54 %".
std::vector<std::string> rectangleText(const PaneFigures& figures);

/// What a pane's label says it shows: "onoue-2004 − truth"; under a light with a disc
/// "onoue-2004, share V of the light that is seen".
std::string titleOf(const PaneContent& content, const LightAngles& light);

}  // namespace gnomon::app
