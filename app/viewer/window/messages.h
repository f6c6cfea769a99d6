#pragma once

#include <string>

#include "viewer/panes/layout.h"
#include "viewer/session/view_session.h"

namespace gnomon::app {

/// The answer to what a person asked for last.
struct Notice {
  std::string text;  ///< empty for none
  bool isError = false;
};

/// A box at the lower border of the pictures with the notice, which goes with the next input.
void drawNotice(const Notice& notice, const WindowLayout& layout);

/// A box over the pictures with everything that stands in the way; nothing where nothing does.
void drawErrors(const ViewSession& session, const WindowLayout& layout);

/// What is still missing before there is a first picture.
void drawWaiting(const ViewSession& session, const WindowLayout& layout);

}  // namespace gnomon::app
