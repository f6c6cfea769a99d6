#include "viewer/window/screen.h"

#include <epoxy/gl.h>
#include <fmt/core.h>

#include <algorithm>

#include "render/gl_objects.h"
#include "viewer/window/input.h"

namespace gnomon::app {
namespace {

constexpr float padding = 12;
constexpr ImU32 alarmBox = IM_COL32(255, 240, 238, 242);

/// A box with texts below each other, all broken at its width.
class TextBox {
 public:
  TextBox(std::vector<std::string> texts, float width) : texts_(std::move(texts)), width_(width) {
    for (const std::string& text : texts_) height_ += heightOf(text);
  }
  [[nodiscard]] float height() const { return height_; }

  void draw(ImVec2 begin, ImU32 box, ImU32 colour) const {
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    const ImVec2 end(begin.x + width_, begin.y + height_);
    list.AddRectFilled(begin, end, box, 5);
    list.AddRect(begin, end, colour, 5);
    float y = begin.y + 8;
    for (const std::string& text : texts_) {
      list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), ImVec2(begin.x + padding, y), colour,
                   text.c_str(), nullptr, width_ - 2 * padding);
      y += heightOf(text);
    }
  }

 private:
  [[nodiscard]] float heightOf(const std::string& text) const {
    return ImGui::CalcTextSize(text.c_str(), nullptr, false, width_ - 2 * padding).y + 4;
  }

  std::vector<std::string> texts_;
  float width_;
  float height_ = 12;
};

/// A box at the lower border of the pictures with the notice, which goes with the next input.
void drawNotice(const Notice& notice, const WindowLayout& layout) {
  if (notice.text.empty()) return;
  const auto room = static_cast<float>(layout.pictures.size.x) - 40;
  const float own = ImGui::CalcTextSize(notice.text.c_str()).x + 2 * padding + 1;
  const float width = std::min(room, own);
  const TextBox box({notice.text}, width);
  const ImVec2 middle =
      point(layout.pictures.corner + Vec2(layout.pictures.size.x / 2, layout.pictures.size.y));
  box.draw(ImVec2(middle.x - width / 2, middle.y - box.height() - 48),
           notice.isError ? alarmBox : ink::chip, notice.isError ? ink::alarm : ink::text);
}

/// A box over the pictures with everything that stands in the way; nothing where nothing does.
void drawErrors(const ViewSession& session, const WindowLayout& layout) {
  const std::vector<std::string> errors = session.errors();
  if (errors.empty()) return;
  const auto width = static_cast<float>(layout.pictures.size.x) - 40;
  const TextBox box(errors, width);
  const ImVec2 middle = point(layout.pictures.corner + layout.pictures.size / 2.0);
  box.draw(ImVec2(middle.x - width / 2, middle.y - box.height() / 2), alarmBox, ink::alarm);
}

/// What is still missing before there is a first picture.
void drawWaiting(const ViewSession& session, const WindowLayout& layout) {
  if (session.hasScene()) return;
  const WorkStatus work = session.baking();
  const std::string text =
      work.stage.empty() ? "Starting" : fmt::format("{} {:.0f} %", work.stage, 100 * work.share);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 middle = point(layout.pictures.corner + layout.pictures.size / 2.0);
  ImGui::GetBackgroundDrawList()->AddText(ImVec2(middle.x - size.x / 2, middle.y), ink::faint,
                                          text.c_str());
}

}  // namespace

void Screen::arrange(ViewSession& session, int width, int height) {
  ViewState& state = session.state();
  layout_ = windowLayout(width, height, {state.panel, state.overlays.section, state.paneCount});
  state.camera.width = static_cast<int>(layout_.panes.front().size.x);
  state.camera.height = static_cast<int>(layout_.panes.front().size.y);
}

Actions Screen::describe(ViewSession& session, const FrameLog& frames, const Notice& notice,
                         int activePane) {
  const ImVec2 cursor = ImGui::GetIO().MousePos;
  const ViewState& state = session.state();
  if (session.hasScene()) panes_.draw(session, layout_, activePane);
  drawWaiting(session, layout_);
  if (state.overlays.section) section_.draw(session, layout_, {cursor.x, cursor.y});
  if (state.overlays.pixel) drawPixelText(session, probe_, layout_, {cursor.x, cursor.y});
  Actions actions;
  if (state.panel) actions = drawControls(session, layout_.panel, frames);
  drawErrors(session, layout_);
  drawNotice(notice, layout_);
  if (state.help) drawKeyList(layout_);
  return actions;
}

void Screen::describePanes(const ViewSession& session) {
  const ImVec2 cursor = ImGui::GetIO().MousePos;
  panes_.draw(session, layout_, -1);
  if (session.state().overlays.section) section_.draw(session, layout_, {cursor.x, cursor.y});
}

image::Image pictureOf(const Gui& gui, int width, int height) {
  const render::Target target(width, height, {GL_RGBA8});
  target.bind();
  gui.draw(width, height);
  return {width, height, target.read<std::uint8_t>(0, GL_RGB, GL_UNSIGNED_BYTE, 3)};
}

}  // namespace gnomon::app
