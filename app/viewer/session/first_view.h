#pragma once

#include <string>

#include "viewer/session/opened_study.h"
#include "viewer/session/view_state.h"

namespace gnomon::app {

/// The method that a study is first looked at with: the first of its own that can be shown, but for
/// the control `unshadowed`, which casts no shadow to look at, where there is another one.
const std::string& firstMethod(const OpenedStudy& opened);

/// What the window opens with: the study's first camera (or one that sees all of the surface), its
/// first light, and the panes and overlays that are asked for; by default `firstMethod` beside the
/// truth.
/// @throws UsageError for contents that are none, or other than one, two or four of them; for a
///   rectangle that is none
ViewState firstView(const OpenedStudy& opened);

}  // namespace gnomon::app
