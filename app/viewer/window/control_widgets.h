#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::app {

/// Where a control is on the screen, window pixels: left, top, right, bottom.
using ControlPlaces = std::map<std::string, std::array<int, 4>>;

/// The controls of the panel, each with a name by which scripts find its place, and with a hint
/// that is shown while the cursor is over it.
class ControlWidgets {
 public:
  static void heading(const char* text);
  static void faintText(const std::string& text);

  bool button(const char* label, const std::string& name, const char* hint);
  bool checkbox(const char* label, const std::string& name, bool& value, const char* hint);
  bool radio(const std::string& label, const std::string& name, bool isChosen, const char* hint);
  bool slider(const char* label, const std::string& name, double& value, double low, double high,
              const char* format, const char* hint);
  bool slider(const char* label, const std::string& name, int& value, int low, int high,
              const char* hint);
  /// A field of text. @return whether Enter was pressed in it
  /// @param whenEmpty  what stands in it while it is empty
  bool field(const std::string& name, std::string& text, const char* whenEmpty, const char* hint);
  /// A heading that opens and closes what stands below it. @return whether it is open
  bool section(const char* text, const std::string& name, const char* hint);

  /// Opens a drop-down, which Escape closes. To be ended by ImGui::EndCombo where it is open.
  bool openList(const char* label, const std::string& name, const std::string& shown,
                const char* hint);
  /// A line of an open drop-down. @return whether it was pressed
  bool entry(const std::string& text, const std::string& name, bool isChosen);
  /// A drop-down of texts, of which one may be chosen now.
  /// @return the place of the one that was pressed
  std::optional<std::size_t> list(const char* label, const std::string& name,
                                  const std::vector<std::string>& entries,
                                  std::optional<std::size_t> chosen, const char* hint);

  /// Keeps in mind where the control is that was just drawn, and shows its hint.
  void note(const std::string& name, const char* hint = nullptr);
  /// Begins a frame: all controls are drawn anew.
  void begin(bool showHints) {
    places_.clear();
    showHints_ = showHints;
  }
  [[nodiscard]] const ControlPlaces& places() const { return places_; }

 private:
  ControlPlaces places_;
  bool showHints_ = true;
};

}  // namespace gnomon::app
