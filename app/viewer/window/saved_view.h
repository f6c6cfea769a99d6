#pragma once

#include <filesystem>
#include <string>

#include "image/images.h"
#include "viewer/session/view_session.h"

namespace gnomon::app {

/// What a person saves from the window: `OUT/NAME/view/view-N…`, N the first number that is
/// free.

/// The state as a study that `gnomon run` reproduces, and beside it what the screen says of it.
/// @return what was written, for the person
/// @throws InputError where it cannot be written
std::string saveStudyView(const ViewSession& session);

/// The window's content.
std::string savePicture(const ViewSession& session, const image::Image& picture);

/// The masks of the panes that show one; maps of shares where the light has a disc.
std::string saveMasks(ViewSession& session);

/// What is on the screen, as JSON: the panes with their figures, light, camera and overlays.
std::string screenJson(const ViewSession& session);

}  // namespace gnomon::app
