#include "viewer/window/control_widgets.h"

#include <imgui.h>

#include "viewer/panes/gui.h"

namespace gnomon::app::widgets {

void heading(const char* text) {
  ImGui::Dummy(ImVec2(0, 2));
  ImGui::PushStyleColor(ImGuiCol_Text, ink::faint);
  ImGui::TextUnformatted(text);
  ImGui::PopStyleColor();
}

void faintText(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, ink::faint);
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

void hintOf(const char* hint) {
  if (!ImGui::IsItemHovered()) return;
  constexpr float widest = 340;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(widest);
  ImGui::TextUnformatted(hint);
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

bool button(const char* label, const char* hint) {
  const bool isPressed = ImGui::Button(label);
  hintOf(hint);
  return isPressed;
}

bool checkbox(const char* label, bool& value, const char* hint) {
  const bool isChanged = ImGui::Checkbox(label, &value);
  hintOf(hint);
  return isChanged;
}

bool radio(const std::string& label, bool isChosen, const char* hint) {
  const bool isPressed = ImGui::RadioButton(label.c_str(), isChosen);
  hintOf(hint);
  return isPressed;
}

bool slider(const char* label, double& value, double low, double high, const char* format,
            const char* hint) {
  const bool isChanged = ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &low, &high,
                                             format, ImGuiSliderFlags_AlwaysClamp);
  hintOf(hint);
  return isChanged;
}

bool slider(const char* label, int& value, int low, int high, const char* hint) {
  const bool isChanged =
      ImGui::SliderInt(label, &value, low, high, "%d", ImGuiSliderFlags_AlwaysClamp);
  hintOf(hint);
  return isChanged;
}

bool openList(const char* label, const std::string& shown, const char* hint) {
  const bool isOpen = ImGui::BeginCombo(label, shown.c_str(), ImGuiComboFlags_HeightLarge);
  if (!isOpen) {
    hintOf(hint);
  } else if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) {
    ImGui::CloseCurrentPopup();
  }
  return isOpen;
}

std::optional<std::size_t> list(const char* label, const std::vector<std::string>& entries,
                                std::optional<std::size_t> chosen, const char* hint) {
  std::optional<std::size_t> pressed;
  if (!openList(label, chosen ? entries.at(*chosen) : "other", hint)) return pressed;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Selectable(entries[i].c_str(), i == chosen)) pressed = i;
    ImGui::PopID();
  }
  ImGui::EndCombo();
  return pressed;
}

}  // namespace gnomon::app::widgets
