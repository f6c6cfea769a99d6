#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::app::widgets {

/// The kinds of controls in the panel. Each has a hint that is shown while the cursor is over it.

void heading(const char* text);
void faintText(const std::string& text);

bool button(const char* label, const char* hint);
bool checkbox(const char* label, bool& value, const char* hint);
bool radio(const std::string& label, bool isChosen, const char* hint);
bool slider(const char* label, double& value, double low, double high, const char* format,
            const char* hint);
bool slider(const char* label, int& value, int low, int high, const char* hint);

/// Opens a drop-down, which Escape closes. To be ended by ImGui::EndCombo where it is open.
bool openList(const char* label, const std::string& shown, const char* hint);
/// A drop-down of texts, of which one may be chosen now.
/// @return the place of the one that was pressed
std::optional<std::size_t> list(const char* label, const std::vector<std::string>& entries,
                                std::optional<std::size_t> chosen, const char* hint);

/// The hint of the control that was drawn last.
void hintOf(const char* hint);

}  // namespace gnomon::app::widgets
