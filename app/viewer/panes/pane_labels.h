#pragma once

#include "viewer/panes/layout.h"
#include "viewer/session/pixel_probe.h"
#include "viewer/session/view_session.h"

namespace gnomon::app {

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

/// "2.41 % wrong: 1.20 % false shadow, 1.21 % false light; IoU 0.873"; of shares the mean of |ΔV|,
/// "2.41 % mean |ΔV|: …".
std::string figuresText(const PaneFigures& figures);

/// What a pane's label says it shows: "onoue-2004 − truth"; under a light with a disc
/// "V of onoue-2004, radius 0.266°".
std::string titleOf(const PaneContent& content, const LightAngles& light);

}  // namespace gnomon::app
