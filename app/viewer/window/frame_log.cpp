#include "viewer/window/frame_log.h"

#include <fmt/core.h>

#include <algorithm>

namespace gnomon::app {

void FrameLog::end(bool drawn) {
  const double spent = std::chrono::duration<double, std::milli>(Clock::now() - begin_).count();
  longest_ = std::max(longest_, spent);
  if (!drawn) return;
  last_ = spent;
  total_ += spent;
  ++count_;
}

double FrameLog::meanMilliseconds() const {
  return count_ == 0 ? 0 : total_ / static_cast<double>(count_);
}

std::string FrameLog::text() const {
  if (count_ == 0) return "frames: none drawn";
  return fmt::format("frames: {} drawn, mean {:.1f} ms ({:.0f} a second), longest of all {:.1f} ms",
                     count_, meanMilliseconds(), 1000 / meanMilliseconds(), longest_);
}

}  // namespace gnomon::app
