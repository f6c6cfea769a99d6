#include "report/text/interval_text.h"

#include <fmt/core.h>

#include <cmath>

#include "report/text/number_text.h"

namespace gnomon::report {

std::string intervalEndText(std::optional<double> end) {
  if (!end) return "–";
  const double percent = 100 * requireFinite(*end, "interval");
  const double rounded = std::round(100 * percent) / 100;
  return fmt::format("{}{:.2f}", rounded < 0 ? "−" : "", std::abs(rounded));
}

std::string intervalText(const std::optional<compare::Interval>& interval) {
  return interval ? intervalEndText(interval->low) + " to " + intervalEndText(interval->high) : "–";
}

std::optional<double> lowOf(const std::optional<compare::Interval>& interval) {
  return interval ? std::optional(interval->low) : std::nullopt;
}

std::optional<double> highOf(const std::optional<compare::Interval>& interval) {
  return interval ? std::optional(interval->high) : std::nullopt;
}

}  // namespace gnomon::report
