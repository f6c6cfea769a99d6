#pragma once

#include <span>

#include "viewer/panes/layout.h"
#include "viewer/session/view_session.h"
#include "viewer/window/controls.h"

namespace gnomon::app {

/// Turns what keyboard and mouse did since the last frame into changes of the state, where the
/// panels do not take it.
class Input {
 public:
  /// @param layout  of the frame that the person has seen
  /// @param keys    that went down, as GLFW numbers them
  Actions apply(ViewSession& session, const WindowLayout& layout, std::span<const int> keys);

  /// The pane that keys speak of: the one under the cursor last.
  [[nodiscard]] int activePane() const { return activePane_; }

 private:
  void drag(ViewState& state, const WindowLayout& layout);
  Actions press(ViewSession& session, std::span<const int> keys);
  void choose(ViewSession& session, int step);

  enum class Drag { none, orbit, pan, light, wipe, rectangle };
  Drag drag_ = Drag::none;
  Vec2 dragBegin_{0, 0};  ///< window pixels
  int activePane_ = 0;
};

/// The list of keys, over everything.
void drawKeyList(const WindowLayout& layout);

}  // namespace gnomon::app
