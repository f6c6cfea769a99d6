#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/viewer/virtual_display.h"
#include "end_to_end/support/program.h"

namespace gnomon::test {

/// Columns on a part of a sphere: every slider has something to move.
std::string ballStudy();

/// A test with that study, `ball.toml`, and a display for the viewer's window.
class ViewerWindow : public EndToEnd {
 protected:
  void SetUp() override;
  [[nodiscard]] DrivenViewer open(std::vector<std::string> arguments,
                                  const std::vector<std::string>& environment = {}) const;

  VirtualDisplay display_;
};

/// RGB pictures of one size.
std::size_t differingPixels(const std::filesystem::path& a, const std::filesystem::path& b);

/// Waits for a file.
bool appears(const std::filesystem::path& path);

}  // namespace gnomon::test
