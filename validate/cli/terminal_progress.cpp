#include "cli/terminal_progress.h"

#include <fmt/core.h>

#include "cli/output.h"

namespace gnomon {

TerminalProgress::TerminalProgress(std::string title)
    : title_(std::move(title)), enabled_(progressWanted()), stageStart_(Clock::now()) {}

TerminalProgress::~TerminalProgress() {
  clear();
}

void TerminalProgress::update(std::string_view stage, double share) {
  if (!enabled_) return;
  const Clock::time_point now = Clock::now();
  if (stage != stage_ || share == 0) {
    stage_ = stage;
    stageStart_ = now;
  }
  using std::chrono::duration;
  const double elapsed = duration<double>(now - stageStart_).count();
  constexpr double quietSeconds = 0.5;
  constexpr double refreshSeconds = 0.1;
  if (elapsed < quietSeconds || duration<double>(now - lastShown_).count() < refreshSeconds) return;
  lastShown_ = now;
  shown_ = true;
  const std::string left =
      share > 0.01 ? fmt::format(", {:.0f} s left", elapsed * (1 - share) / share) : "";
  printError(fmt::format("\r\033[K{}: {} {:.0f} %{}", title_, stage_, 100 * share, left));
}

void TerminalProgress::clear() {
  if (shown_) printError("\r\033[K");
  shown_ = false;
}

}  // namespace gnomon
