#pragma once

#include <imgui.h>

#include "common/vec.h"

namespace gnomon::app {

/// Dear ImGui with Gnomon's letters and colours, drawn by OpenGL: needs the context, in a window or
/// without one.
class Gui {
 public:
  Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;
  ~Gui();

  /// Begins a frame in a window that Dear ImGui's GLFW part was told of.
  void beginInWindow() const;
  /// Whether the person holds or does something in this frame.
  [[nodiscard]] bool hasInput() const;
  /// Begins a frame without a window.
  /// @param cursor  pixels; outside the picture for none
  void beginWithoutWindow(int width, int height, ImVec2 cursor) const;
  /// Ends the frame and draws it into the framebuffer that is bound.
  void draw(int width, int height) const;

 private:
  ImGuiContext* context_;
};

/// A place as Dear ImGui takes it, pixels.
inline ImVec2 point(Vec2 place) {
  return {static_cast<float>(place.x), static_cast<float>(place.y)};
}

/// Colours of text over the pictures and of lines in panels.
namespace ink {
constexpr ImU32 text = IM_COL32(28, 30, 34, 255);
constexpr ImU32 faint = IM_COL32(112, 116, 124, 255);
constexpr ImU32 chip = IM_COL32(255, 255, 255, 226);
constexpr ImU32 line = IM_COL32(150, 154, 162, 255);
constexpr ImU32 alarm = IM_COL32(176, 24, 24, 255);
}  // namespace ink

}  // namespace gnomon::app
