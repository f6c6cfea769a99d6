#include "viewer/window/screen.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "render/target.h"
#include "viewer/window/input.h"

namespace gnomon::app {

void Screen::arrange(ViewSession& session, int width, int height) {
  ViewState& state = session.state();
  layout_ = windowLayout(width, height, {state.panel, state.overlays.section, state.paneCount});
  state.camera.width = static_cast<int>(layout_.panes.front().size.x);
  state.camera.height = static_cast<int>(layout_.panes.front().size.y);
}

Actions Screen::describe(ViewSession& session, const PanelFacts& facts, const Notice& notice,
                         int activePane) {
  const ImVec2 cursor = ImGui::GetIO().MousePos;
  const ViewState& state = session.state();
  // What a film shows is the panes alone.
  const bool isRecorded = facts.path.isRecording;
  if (session.hasScene()) panes_.draw(session, layout_, isRecorded ? -1 : activePane);
  drawWaiting(session, layout_);
  if (state.overlays.section) section_.draw(session, layout_, {cursor.x, cursor.y});
  if (state.overlays.pixel && !isRecorded) {
    drawPixelText(session, probe_, layout_, {cursor.x, cursor.y});
  }
  Actions actions;
  if (state.panel) actions = controls_.draw(session, layout_.panel, facts);
  if (isRecorded) return actions;
  drawErrors(session, layout_);
  drawNotice(notice, layout_);
  if (state.help) drawKeyList(layout_);
  return actions;
}

image::Image pictureOf(const Gui& gui, int width, int height) {
  const render::Target target(width, height, {GL_RGBA8});
  target.bind();
  gui.draw(width, height);
  return {width, height, target.read<std::uint8_t>(0, GL_RGB, GL_UNSIGNED_BYTE, 3)};
}

image::Image cutOut(const image::Image& picture, const PaneRectangle& rectangle) {
  const auto at = [](double place, int end) { return std::clamp(static_cast<int>(place), 0, end); };
  const int left = at(rectangle.corner.x, picture.width);
  const int top = at(rectangle.corner.y, picture.height);
  const int right = at(rectangle.corner.x + rectangle.size.x, picture.width);
  const int bottom = at(rectangle.corner.y + rectangle.size.y, picture.height);
  image::Image part{right - left, bottom - top, {}};
  for (int row = top; row < bottom; ++row) {
    const auto line = picture.rgb.begin() + 3 * static_cast<std::ptrdiff_t>(row) * picture.width;
    part.rgb.insert(part.rgb.end(), line + 3 * left, line + 3 * right);
  }
  return part;
}

}  // namespace gnomon::app
