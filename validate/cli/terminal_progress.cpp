#include "cli/terminal_progress.h"

#include <fmt/core.h>

#include <algorithm>

#include "cli/output.h"
#include "common/time_left.h"

namespace gnomon::cli {

TerminalProgress::TerminalProgress(std::string title, std::size_t cases)
    : cases_(cases),
      start_(Clock::now()),
      caseStart_(start_),
      title_(std::move(title)),
      enabled_(progressWanted()),
      stageStart_(start_) {}

TerminalProgress::~TerminalProgress() {
  clear();
}

void TerminalProgress::beginCase(std::string title) {
  ++current_;
  title_ = std::move(title);
  caseStart_ = Clock::now();
}

void TerminalProgress::update(std::string_view stage, double share) {
  if (!enabled_) return;
  const Clock::time_point now = Clock::now();
  if (stage != stage_ || share == 0) {
    stage_ = stage;
    stageStart_ = now;
  }
  using std::chrono::duration;
  constexpr double quietSeconds = 0.5;
  constexpr double refreshSeconds = 0.1;
  // Cases may be short where all of them are not.
  const double elapsed = duration<double>(now - (cases_ > 1 ? start_ : stageStart_)).count();
  if (elapsed < quietSeconds || duration<double>(now - lastShown_).count() < refreshSeconds) return;
  lastShown_ = now;
  shown_ = true;
  const std::string which =
      cases_ > 1 ? fmt::format("case {} of {}, ", std::max<std::size_t>(current_, 1), cases_) : "";
  printError(fmt::format("\r\033[K{}: {}{} {:.0f} %{}", title_, which, stage_, 100 * share,
                         leftText(share, now)));
}

std::string TerminalProgress::leftText(double share, Clock::time_point now) const {
  using std::chrono::duration;
  if (cases_ > 1) {
    if (current_ < 2) return "";
    return fmt::format(", {} left in all",
                       durationText(secondsLeft(current_ - 1, cases_,
                                                duration<double>(caseStart_ - start_).count(),
                                                duration<double>(now - caseStart_).count())));
  }
  const double elapsed = duration<double>(now - stageStart_).count();
  return share > 0.01 ? fmt::format(", {:.0f} s left", elapsed * (1 - share) / share) : "";
}

void TerminalProgress::clear() {
  if (shown_) printError("\r\033[K");
  shown_ = false;
}

}  // namespace gnomon::cli
