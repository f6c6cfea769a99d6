#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "viewer/panes/layout.h"
#include "viewer/session/view_session.h"

namespace gnomon::app {

/// What a person asks for by keys and buttons, beside changes of the state.
struct Actions {
  bool saveStudy = false;
  bool savePicture = false;
  bool saveMasks = false;
  bool close = false;

  Actions& operator+=(const Actions& other) {
    saveStudy = saveStudy || other.saveStudy;
    savePicture = savePicture || other.savePicture;
    saveMasks = saveMasks || other.saveMasks;
    close = close || other.close;
    return *this;
  }
};

/// How long frames take, from the moment that input is read until the picture is handed over.
class FrameLog {
 public:
  void begin() { begin_ = Clock::now(); }
  /// @param drawn  whether the frame drew a pane anew: those that did not do not count
  void end(bool drawn);

  [[nodiscard]] double lastMilliseconds() const { return last_; }
  [[nodiscard]] double longestMilliseconds() const { return longest_; }
  /// "frames: 120 drawn, mean 21.3 ms (47 a second), longest of all 80.2 ms".
  [[nodiscard]] std::string text() const;

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_ = Clock::now();
  double last_ = 0;
  double longest_ = 0;
  double total_ = 0;
  std::size_t count_ = 0;
};

/// The panel beside the pictures. Changes the session's state, never anything else.
Actions drawControls(ViewSession& session, const PaneRectangle& place, const FrameLog& frames);

}  // namespace gnomon::app

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
