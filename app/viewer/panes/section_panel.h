#pragma once

#include <optional>

#include "model/cross_section.h"
#include "truth/shadow_tracer.h"
#include "viewer/panes/layout.h"
#include "viewer/session/view_session.h"

namespace gnomon::app {

/// The cross-section through the pixel under the cursor, drawn live: Figures 1 and 2 of Onoue, Max
/// & Nishita 2004.
class SectionPanel {
 public:
  /// @param cursor  window pixels; the last sample stays while it is over no surface
  void draw(const ViewSession& session, const WindowLayout& layout, Vec2 cursor);

 private:
  void find(const ViewSession& session, const WindowLayout& layout, Vec2 cursor);

  /// What the section was made from: it is made again when any of it changes.
  struct Key {
    int face = -1;
    float s = 0, t = 0;
    std::uint64_t serial = 0;
    std::optional<cache::ContentKey> traced;  ///< of the displaced surface, once it is there
    friend bool operator==(const Key&, const Key&) = default;
  };
  Key key_;
  std::optional<CrossSection> section_;
  std::optional<truth::Occluder> occluder_;  ///< toward the light's centre
  double tracedShare_ = 0;                   ///< V of the light's disc, where it has one
  Vec2 pixel_{0, 0};                         ///< where the sample is, window pixels
};

}  // namespace gnomon::app
