#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/camera.h"
#include "model/light_angles.h"
#include "model/picking.h"
#include "model/saved_study.h"

namespace gnomon::app {

/// All that a person chooses in the window, as a value.

/// What answers in a pane. A method may have any label, those of the other kinds too.
struct PaneSource {
  enum class Kind {
    method,
    truth,     ///< the traced truth
    displaced  ///< the displaced surface's own rays: a picture, not a mask
  };
  Kind kind = Kind::method;
  std::string label;  ///< a method's; empty for the others

  [[nodiscard]] bool isMethod() const { return kind == Kind::method; }
  friend bool operator==(const PaneSource&, const PaneSource&) = default;
};

inline const PaneSource tracedTruth{PaneSource::Kind::truth, {}};
inline const PaneSource displacedSurface{PaneSource::Kind::displaced, {}};
inline PaneSource methodSource(std::string label) {
  return {PaneSource::Kind::method, std::move(label)};
}

/// What one pane shows: a mask, or the signed difference of two.
struct PaneContent {
  PaneSource shown;
  std::optional<PaneSource> against = {};  ///< a method or the truth; none for no difference

  [[nodiscard]] bool isDifference() const { return against.has_value(); }
  friend bool operator==(const PaneContent&, const PaneContent&) = default;
};

/// "onoue-2004", "truth" or "displaced".
std::string sourceText(const PaneSource& source);

/// The same, or "onoue-2004:truth" for a difference.
std::string contentText(const PaneContent& content);

/// The inverse; a text that is both a method's label and another source's name is the method.
/// @param labels  the methods there are
/// @throws UsageError listing what there is, for a name that is none of it
PaneContent parseContent(const std::string& text, const std::vector<std::string>& labels);

/// What is drawn over the pictures.
struct Overlays {
  bool curvature = false;   ///< normal curvature along the light
  bool directions = false;  ///< principal directions
  bool section = false;     ///< the cross-section through the pixel under the cursor
  bool pixel = false;       ///< what is known of that pixel
  friend bool operator==(const Overlays&, const Overlays&) = default;
};

struct ViewState {
  Camera camera;  ///< its width and height are those of a pane
  LightAngles light;
  int paneCount = 1;  ///< 1, 2 (one over the other, parted by the wipe) or 4
  std::array<PaneContent, 4> panes;
  double wipe = 0.5;  ///< where the second of two panes begins, share of the width
  Overlays overlays;
  StudyChanges changes;          ///< what the sliders have made of the study
  std::optional<ViewPart> part;  ///< the rectangle whose error is told
  bool panel = true;             ///< the controls are shown
  bool help = false;
};

bool sameCamera(const Camera& a, const Camera& b);

/// The methods that its panes need, each once.
std::vector<std::string> shownMethods(const ViewState& state);

/// Whether a pane needs the truth.
bool needsTruth(const PaneContent& content);

}  // namespace gnomon::app
