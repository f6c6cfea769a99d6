#include "common/progress.h"

#include <fmt/core.h>

#include <algorithm>

namespace gnomon {

double secondsLeft(std::size_t done, std::size_t cases, double elapsed, double current) {
  const double average = elapsed / static_cast<double>(done);
  const auto others = static_cast<double>(cases - std::min(cases, done + 1));
  return others * average + std::max(0.0, average - current);
}

std::string durationText(double seconds) {
  if (seconds < 99.5) return fmt::format("{:.0f} s", seconds);
  if (seconds < 99.5 * 60) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

}  // namespace gnomon
