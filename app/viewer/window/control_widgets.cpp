#include "viewer/window/control_widgets.h"

#include <fmt/core.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "viewer/panes/gui.h"

namespace gnomon::app {

void ControlWidgets::heading(const char* text) {
  ImGui::Dummy(ImVec2(0, 2));
  ImGui::PushStyleColor(ImGuiCol_Text, ink::faint);
  ImGui::TextUnformatted(text);
  ImGui::PopStyleColor();
}

void ControlWidgets::faintText(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, ink::faint);
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

void ControlWidgets::note(const std::string& name, const char* hint) {
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 high = ImGui::GetItemRectMax();
  places_[name] = {static_cast<int>(low.x), static_cast<int>(low.y), static_cast<int>(high.x),
                   static_cast<int>(high.y)};
  if (!showHints_ || hint == nullptr || !ImGui::IsItemHovered()) return;
  constexpr float widest = 340;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(widest);
  ImGui::TextUnformatted(hint);
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

bool ControlWidgets::button(const char* label, const std::string& name, const char* hint) {
  const bool isPressed = ImGui::Button(label);
  note(name, hint);
  return isPressed;
}

bool ControlWidgets::checkbox(const char* label, const std::string& name, bool& value,
                              const char* hint) {
  const bool isChanged = ImGui::Checkbox(label, &value);
  note(name, hint);
  return isChanged;
}

bool ControlWidgets::radio(const std::string& label, const std::string& name, bool isChosen,
                           const char* hint) {
  const bool isPressed = ImGui::RadioButton(label.c_str(), isChosen);
  note(name, hint);
  return isPressed;
}

bool ControlWidgets::slider(const char* label, const std::string& name, double& value, double low,
                            double high, const char* format, const char* hint) {
  const bool isChanged = ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &low, &high,
                                             format, ImGuiSliderFlags_AlwaysClamp);
  note(name, hint);
  return isChanged;
}

bool ControlWidgets::slider(const char* label, const std::string& name, int& value, int low,
                            int high, const char* hint) {
  const bool isChanged =
      ImGui::SliderInt(label, &value, low, high, "%d", ImGuiSliderFlags_AlwaysClamp);
  note(name, hint);
  return isChanged;
}

bool ControlWidgets::field(const std::string& name, std::string& text, const char* whenEmpty,
                           const char* hint) {
  const bool isEntered = ImGui::InputTextWithHint(
      fmt::format("##{}", name).c_str(), whenEmpty, &text,
      ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  note(name, hint);
  return isEntered;
}

bool ControlWidgets::section(const char* text, const std::string& name, const char* hint) {
  const bool isOpen = ImGui::CollapsingHeader(text);
  note(name, hint);
  return isOpen;
}

bool ControlWidgets::openList(const char* label, const std::string& name, const std::string& shown,
                              const char* hint) {
  const bool isOpen = ImGui::BeginCombo(label, shown.c_str(), ImGuiComboFlags_HeightLarge);
  // An open list is a window of its own: its first line is not the control.
  note(name, isOpen ? nullptr : hint);
  if (isOpen && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) {
    ImGui::CloseCurrentPopup();
  }
  return isOpen;
}

bool ControlWidgets::entry(const std::string& text, const std::string& name, bool isChosen) {
  const bool isPressed = ImGui::Selectable(text.c_str(), isChosen);
  note(name);
  return isPressed;
}

std::optional<std::size_t> ControlWidgets::list(const char* label, const std::string& name,
                                                const std::vector<std::string>& entries,
                                                std::optional<std::size_t> chosen,
                                                const char* hint) {
  std::optional<std::size_t> pressed;
  if (!openList(label, name, chosen ? entries.at(*chosen) : "other", hint)) return pressed;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    if (entry(entries[i], fmt::format("{}.{}", name, i), i == chosen)) pressed = i;
    ImGui::PopID();
  }
  ImGui::EndCombo();
  return pressed;
}

}  // namespace gnomon::app
