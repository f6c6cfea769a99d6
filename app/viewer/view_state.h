#pragma once

#include <array>
#include <compare>
#include <string>
#include <string_view>
#include <vector>

#include "common/camera.h"
#include "model/light_angles.h"
#include "model/saved_study.h"

namespace gnomon {

/// All that a person chooses in the window, as a value.

/// What one pane shows: a mask, or the signed difference of two.
struct PaneContent {
  static constexpr std::string_view truth = "truth";          ///< the traced truth
  static constexpr std::string_view displaced = "displaced";  ///< the displaced surface's own rays

  std::string shown;    ///< a method's label, `truth` or `displaced`
  std::string against;  ///< a method's label or `truth`; empty for no difference

  [[nodiscard]] bool isDifference() const { return !against.empty(); }
  friend auto operator<=>(const PaneContent&, const PaneContent&) = default;
};

/// Whether a name stands for one of the study's methods.
bool isMethod(std::string_view name);

/// "onoue-2004", "truth", "displaced", or "onoue-2004:truth" for a difference.
std::string contentText(const PaneContent& content);

/// The inverse.
/// @param labels  the methods there are
/// @throws UsageError listing what there is, for a name that is none of it
PaneContent parseContent(const std::string& text, const std::vector<std::string>& labels);

/// What is drawn over the pictures.
struct Overlays {
  bool curvature = false;   ///< normal curvature along the light
  bool directions = false;  ///< principal directions
  bool section = false;     ///< the cross-section through the pixel under the cursor
  friend bool operator==(const Overlays&, const Overlays&) = default;
};

struct ViewState {
  Camera camera;  ///< its width and height are those of a pane
  LightAngles light;
  int paneCount = 1;  ///< 1, 2 (one over the other, parted by the wipe) or 4
  std::array<PaneContent, 4> panes;
  double wipe = 0.5;  ///< where the second of two panes begins, share of the width
  Overlays overlays;
  StudyChanges changes;  ///< what the sliders have made of the study
  bool panel = true;     ///< the controls are shown
  bool help = false;
};

/// The methods that its panes need, each once.
std::vector<std::string> shownMethods(const ViewState& state);

/// Whether a pane needs the truth.
bool needsTruth(const PaneContent& content);

}  // namespace gnomon
