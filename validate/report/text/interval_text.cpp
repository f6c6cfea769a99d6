#include "report/text/interval_text.h"

#include <fmt/core.h>

#include <cmath>

#include "report/text/number_text.h"

namespace gnomon::report {
namespace {

std::string endText(double share) {
  const double percent = 100 * requireFinite(share, "interval");
  const double rounded = std::round(100 * percent) / 100;
  return fmt::format("{}{:.2f}", rounded < 0 ? "−" : "", std::abs(rounded));
}

}  // namespace

std::string intervalText(const std::optional<compare::Interval>& interval) {
  return interval ? endText(interval->low) + " to " + endText(interval->high) : "–";
}

std::optional<double> lowOf(const std::optional<compare::Interval>& interval) {
  return interval ? std::optional(interval->low) : std::nullopt;
}

std::optional<double> highOf(const std::optional<compare::Interval>& interval) {
  return interval ? std::optional(interval->high) : std::nullopt;
}

}  // namespace gnomon::report
