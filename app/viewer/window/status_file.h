#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "viewer/session/view_session.h"
#include "viewer/window/controls.h"
#include "viewer/window/messages.h"

namespace gnomon::app {

/// What is on the screen, as JSON: panes with their figures, light, camera, what is under way.
std::string screenJson(const ViewSession& session);

/// Keeps a file of what is on the screen, for scripts.
class StatusFile {
 public:
  explicit StatusFile(std::optional<std::filesystem::path> path) : path_(std::move(path)) {}

  /// Writes it where something has changed.
  void write(const ViewSession& session, const ControlPlaces& places, const PanelFacts& facts,
             const Notice& notice);

 private:
  std::optional<std::filesystem::path> path_;
  std::string last_;
};

}  // namespace gnomon::app
