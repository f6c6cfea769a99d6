#include "viewer/window/input.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "model/light_angles.h"
#include "viewer/panes/gui.h"

namespace gnomon::app {
namespace {

/// Keys and what they do.
using KeyHelp = std::pair<std::string_view, std::string_view>;
constexpr std::array<KeyHelp, 22> keyHelp = {{
    {"drag", "turn the surface"},
    {"right drag", "move the surface"},
    {"scroll, + \u2212", "nearer, farther"},
    {"L and drag, arrows", "move the light"},
    {"Shift and drag", "a rectangle, which tells its own error; Shift and click removes it"},
    {"1 2 4", "one, two or four panes"},
    {"drag the line, [ ]", "move the line between two panes"},
    {"N B", "next, previous method in the pane under the cursor"},
    {"F", "swap the first two panes"},
    {"T", "show the ray-traced truth in the pane under the cursor"},
    {"G", "show the surface with its real bumps there, ray-traced"},
    {"D", "show where the method there differs from the truth, on and off"},
    {"K", "how strongly the surface bends toward the light"},
    {"V", "lines along which the surface bends most and least"},
    {"X", "cross-section through the pixel under the cursor"},
    {"I", "what every method says of that pixel, and why it is lit or not"},
    {"R", "back to the study's own camera and light"},
    {"S P M", "save a study of this view, a picture, the masks"},
    {"Tab", "controls, on and off"},
    {"Escape", "close what is open; then remove the rectangle"},
    {"?", "this list"},
    {"Q", "quit"},
}};

Vec2 cursor() {
  const ImVec2 place = ImGui::GetIO().MousePos;
  return {place.x, place.y};
}

bool nearWipe(const ViewState& state, const WindowLayout& layout) {
  constexpr double reach = 9;
  return state.paneCount == 2 && std::abs(cursor().x - state.wipe * layout.pictures.size.x) < reach;
}

/// Moves camera and target in the picture's plane, as far as the cursor moves at the target.
Camera panned(Camera camera, Vec2 pixels) {
  const CameraAxes axis = axes(camera);
  const double distance = glm::length(camera.eye - camera.target);
  const double worldPerPixel =
      2 * distance * std::tan(camera.verticalFov / 2) / std::max(camera.height, 1);
  const Vec3 shift = worldPerPixel * (-pixels.x * axis.right + pixels.y * axis.up);
  camera.eye += shift;
  camera.target += shift;
  return camera;
}

Camera zoomedBy(const Camera& camera, double steps) {
  const double distance = glm::length(camera.eye - camera.target);
  return zoomed(camera, std::pow(0.9, steps), {distance * 0.05, distance * 20});
}

bool typed(ImWchar letter) {
  const auto& letters = ImGui::GetIO().InputQueueCharacters;
  return std::find(letters.begin(), letters.end(), letter) != letters.end();
}

}  // namespace

void Input::drag(ViewState& state, const WindowLayout& layout) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool left = ImGui::IsMouseDown(ImGuiMouseButton_Left);
  const bool right = ImGui::IsMouseDown(ImGuiMouseButton_Right);
  if (drag_ == Drag::none && !io.WantCaptureMouse && paneUnder(layout, cursor(), state.wipe) >= 0) {
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
      drag_ = io.KeyShift               ? Drag::rectangle
              : nearWipe(state, layout) ? Drag::wipe
              : io.KeysDown[GLFW_KEY_L] ? Drag::light
                                        : Drag::orbit;
      dragBegin_ = cursor();
      if (drag_ == Drag::rectangle) state.part.reset();
    } else if (ImGui::IsMouseClicked(ImGuiMouseButton_Right)) {
      drag_ = Drag::pan;
    }
  }
  if (!left && !right) drag_ = Drag::none;
  const Vec2 moved(io.MouseDelta.x, io.MouseDelta.y);
  if (drag_ == Drag::none || moved == Vec2(0)) return;
  constexpr double radiansPerPixel = 0.006;
  constexpr double degreesPerPixel = 0.25;
  if (drag_ == Drag::orbit) {
    state.camera = orbited(state.camera, -moved.x * radiansPerPixel, moved.y * radiansPerPixel);
  } else if (drag_ == Drag::pan) {
    state.camera = panned(state.camera, moved);
  } else if (drag_ == Drag::rectangle) {
    const auto pane =
        static_cast<std::size_t>(std::max(0, paneUnder(layout, dragBegin_, state.wipe)));
    state.part = partBetween(dragBegin_, cursor(), layout.panes.at(pane));
  } else if (drag_ == Drag::light) {
    state.light = dragged(state.light, moved.x * degreesPerPixel, -moved.y * degreesPerPixel);
  } else {
    state.wipe = std::clamp(cursor().x / layout.pictures.size.x, 0.0, 1.0);
  }
}

/// The next method, from whatever the pane shows.
void Input::choose(ViewSession& session, int step) {
  PaneContent& content = session.state().panes.at(static_cast<std::size_t>(activePane_));
  const auto& labels = session.labels();
  const auto found = content.shown.isMethod()
                         ? std::find(labels.begin(), labels.end(), content.shown.label)
                         : labels.end();
  const auto count = static_cast<int>(labels.size());
  const int now =
      found == labels.end() ? (step > 0 ? -1 : 0) : static_cast<int>(found - labels.begin());
  content.shown = methodSource(labels[static_cast<std::size_t>((now + step + count) % count)]);
}

Actions Input::press(ViewSession& session, std::span<const int> keys) {
  const auto pressed = [&](int key) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
  };
  ViewState& state = session.state();
  PaneContent& content = state.panes.at(static_cast<std::size_t>(activePane_));
  Actions actions;
  if (ImGui::GetIO().KeyCtrl) return actions;
  if (typed('?')) state.help = !state.help;
  if (pressed(GLFW_KEY_ESCAPE)) {
    if (!state.help) state.part.reset();
    state.help = false;
  }
  for (const auto& [key, count] : {std::pair(GLFW_KEY_1, 1), {GLFW_KEY_2, 2}, {GLFW_KEY_4, 4}}) {
    if (pressed(key)) state.paneCount = count;
  }
  if (pressed(GLFW_KEY_N)) choose(session, 1);
  if (pressed(GLFW_KEY_B)) choose(session, -1);
  if (pressed(GLFW_KEY_F)) std::swap(state.panes[0], state.panes[1]);
  if (pressed(GLFW_KEY_T)) content = {tracedTruth};
  if (pressed(GLFW_KEY_G)) content = {displacedSurface};
  if (pressed(GLFW_KEY_D) && content.shown.isMethod()) {
    content.against = content.isDifference() ? std::nullopt : std::optional(tracedTruth);
  }
  if (pressed(GLFW_KEY_K)) state.overlays.curvature = !state.overlays.curvature;
  if (pressed(GLFW_KEY_V)) state.overlays.directions = !state.overlays.directions;
  if (pressed(GLFW_KEY_X)) state.overlays.section = !state.overlays.section;
  if (pressed(GLFW_KEY_I)) state.overlays.pixel = !state.overlays.pixel;
  if (pressed(GLFW_KEY_TAB)) state.panel = !state.panel;
  if (pressed(GLFW_KEY_R)) session.resetView();
  constexpr double degrees = 1;
  if (pressed(GLFW_KEY_LEFT)) state.light = dragged(state.light, -degrees, 0);
  if (pressed(GLFW_KEY_RIGHT)) state.light = dragged(state.light, degrees, 0);
  if (pressed(GLFW_KEY_UP)) state.light = dragged(state.light, 0, degrees);
  if (pressed(GLFW_KEY_DOWN)) state.light = dragged(state.light, 0, -degrees);
  constexpr double share = 0.02;
  if (typed('[')) state.wipe = std::max(0.0, state.wipe - share);
  if (typed(']')) state.wipe = std::min(1.0, state.wipe + share);
  if (typed('+') || typed('=')) state.camera = zoomedBy(state.camera, 1);
  if (typed('-')) state.camera = zoomedBy(state.camera, -1);
  actions.saveStudy = pressed(GLFW_KEY_S);
  actions.savePicture = pressed(GLFW_KEY_P);
  actions.saveMasks = pressed(GLFW_KEY_M);
  actions.close = pressed(GLFW_KEY_Q);
  return actions;
}

Actions Input::apply(ViewSession& session, const WindowLayout& layout, std::span<const int> keys) {
  const ImGuiIO& io = ImGui::GetIO();
  ViewState& state = session.state();
  const int under = paneUnder(layout, cursor(), state.wipe);
  if (under >= 0 && !io.WantCaptureMouse) activePane_ = under;
  activePane_ = std::min(activePane_, state.paneCount - 1);
  drag(state, layout);
  if (io.MouseWheel != 0 && under >= 0 && !io.WantCaptureMouse) {
    state.camera = zoomedBy(state.camera, io.MouseWheel);
  }
  // What is typed into a slider, and what closes a list, is no key of the viewer.
  const bool isTaken = io.WantTextInput || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
  return isTaken ? Actions{} : press(session, keys);
}

void drawKeyList(const WindowLayout& layout) {
  ImDrawList& list = *ImGui::GetForegroundDrawList();
  const float line = ImGui::GetTextLineHeight() + 5;
  constexpr float column = 160;
  float widest = 0;
  for (const auto& [key, text] : keyHelp) {
    widest = std::max(widest, ImGui::CalcTextSize(text.data(), text.data() + text.size()).x);
  }
  const ImVec2 size(column + widest + 32, line * static_cast<float>(keyHelp.size()) + 24);
  // Over the middle of the pictures, but never cut off at the left or above.
  const double high = layout.pictures.size.y + layout.section.size.y;
  const ImVec2 begin(std::max(4.F, static_cast<float>(layout.pictures.size.x - size.x) / 2),
                     std::max(4.F, static_cast<float>(high - size.y) / 2));
  const ImVec2 end(begin.x + size.x, begin.y + size.y);
  list.AddRectFilled(begin, end, IM_COL32(255, 255, 255, 244), 6);
  list.AddRect(begin, end, ink::line, 6);
  float y = begin.y + 12;
  for (const auto& [key, text] : keyHelp) {
    list.AddText(ImVec2(begin.x + 16, y), ink::text, key.data(), key.data() + key.size());
    list.AddText(ImVec2(begin.x + 16 + column, y), ink::faint, text.data(),
                 text.data() + text.size());
    y += line;
  }
}

}  // namespace gnomon::app
