#include "viewer/window/messages.h"

#include <fmt/core.h>
#include <imgui.h>

#include "viewer/panes/gui.h"

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

}  // namespace

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

void drawErrors(const ViewSession& session, const WindowLayout& layout) {
  const std::vector<std::string> errors = session.errors();
  if (errors.empty()) return;
  const auto width = static_cast<float>(layout.pictures.size.x) - 40;
  const TextBox box(errors, width);
  const ImVec2 middle = point(layout.pictures.corner + layout.pictures.size / 2.0);
  box.draw(ImVec2(middle.x - width / 2, middle.y - box.height() / 2), alarmBox, ink::alarm);
}

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

}  // namespace gnomon::app
