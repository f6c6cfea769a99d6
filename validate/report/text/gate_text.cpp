#include "report/text/gate_text.h"

#include <fmt/core.h>

#include <cmath>

#include "report/text/number_text.h"
#include "study/record/cases.h"

namespace gnomon {
namespace {

std::string anyOr(const std::string& name, const char* kind) {
  return name.empty() ? fmt::format("any {}", kind) : name;
}

/// Enough digits to tell a value from its limit.
std::string valueText(double value) {
  return fmt::format("{:.6g}", value);
}

std::string nameWith(const GateRecord& gate, const std::string& limit) {
  std::string name = fmt::format("{}, {} {}, {}, {}", anyOr(gate.method, "method"), gate.metric,
                                 limit, anyOr(gate.view, "view"), anyOr(gate.light, "light"));
  if (gate.region != wholeRegion) name += ", region " + gate.region;
  if (gate.answer != Answer::drawn) name += fmt::format(", answer {}", answerName(gate.answer));
  const std::size_t slash = gate.step.find('/');
  return slash == std::string::npos ? name : name + ", at " + gate.step.substr(slash + 1);
}

}  // namespace

std::string gateVerdictName(GateVerdict verdict) {
  switch (verdict) {
    case GateVerdict::passed:
      return "pass";
    case GateVerdict::failed:
      return "fail";
    case GateVerdict::undefined:
      return "undefined";
    case GateVerdict::skipped:
      return "skipped";
  }
  throw InternalError("gate: a verdict that has no name");
}

std::string limitText(const GateRecord& gate) {
  if (gate.minimum && gate.maximum) {
    return fmt::format("{} to {}", valueText(*gate.minimum), valueText(*gate.maximum));
  }
  if (gate.maximum) return fmt::format("≤ {}", valueText(*gate.maximum));
  if (gate.minimum) return fmt::format("≥ {}", valueText(*gate.minimum));
  return "no limit";
}

std::string gateName(const GateRecord& gate) {
  return nameWith(gate, limitText(gate));
}

std::string gateTitle(const GateRecord& gate) {
  return nameWith(gate, gate.minimum && gate.maximum ? "range" : gate.maximum ? "max" : "min");
}

std::string gateFaultText(const GateRecord& gate) {
  return fmt::format("{}: {}", gateName(gate), gateOutcome(gate));
}

std::string gateOutcome(const GateRecord& gate) {
  if (gate.verdict == GateVerdict::skipped) return "skipped: " + gate.reason;
  if (gate.verdict == GateVerdict::undefined || !gate.value) return "undefined: " + gate.reason;
  std::string text = valueText(*gate.value);
  const std::optional<double> margin = gate.margin();
  if (gate.verdict == GateVerdict::failed && margin) {
    const bool large = gate.maximum && *gate.value > *gate.maximum;
    text += fmt::format(", too {} by {:.3g}", large ? "large" : "small", std::abs(*margin));
  }
  if (gate.expected) text += fmt::format(", {} committed", valueText(*gate.expected));
  return text;
}

}  // namespace gnomon
