#pragma once

#include "viewer/panes/layout.h"
#include "viewer/session/view_session.h"
#include "viewer/window/controls.h"

namespace gnomon::app {

/// What keys ask for beside changes of the state.
struct InputActions {
  SaveActions save;
  bool close = false;
};

/// Turns what keyboard and mouse did since the last frame into changes of the state, where the
/// panels do not take it.
class Input {
 public:
  /// @param layout  of the frame that the person has seen
  /// @param keys    that went down, as GLFW numbers them
  InputActions apply(ViewSession& session, const WindowLayout& layout, std::span<const int> keys);

  /// The pane that keys speak of: the one under the cursor last.
  [[nodiscard]] int activePane() const { return activePane_; }

 private:
  void drag(ViewState& state, const WindowLayout& layout);
  InputActions press(ViewSession& session, std::span<const int> keys);
  void choose(ViewSession& session, int step);

  enum class Drag { none, orbit, pan, light, wipe };
  Drag drag_ = Drag::none;
  int activePane_ = 0;
};

/// The list of keys, over everything.
void drawKeyList(const WindowLayout& layout);

}  // namespace gnomon::app
