#include "report/text/gate_text.h"

#include <fmt/core.h>

#include <cmath>

#include "common/overloaded.h"
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

std::string nameWith(const Gate& gate, const std::string& limit) {
  std::string name = fmt::format("{}, {} {}, {}, {}", anyOr(gate.method, "method"), gate.metric,
                                 limit, anyOr(gate.view, "view"), anyOr(gate.light, "light"));
  if (gate.region != wholeRegion) name += ", region " + gate.region;
  if (gate.answer != Answer::drawn) name += fmt::format(", answer {}", answerName(gate.answer));
  const std::string value = stepValue(gate.step);
  return value.empty() ? name : name + ", at " + value;
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

std::string gateOriginName(const Gate& gate) {
  return std::visit(Overloaded{[](const Threshold&) { return "threshold"; },
                               [](const Reference&) { return "reference"; },
                               [](const CompareOption&) { return "option"; }},
                    gate.origin);
}

GatePlace gatePlace(const CheckRecord& check, const Gate& gate) {
  return std::visit(Overloaded{[&](const Threshold& threshold) {
                                 return GatePlace{check.file, threshold.line};
                               },
                               [&](const Reference&) { return GatePlace{check.baseline}; },
                               [](const CompareOption&) { return GatePlace{}; }},
                    gate.origin);
}

std::string limitText(const Gate& gate) {
  if (gate.minimum && gate.maximum) {
    return fmt::format("{} to {}", valueText(*gate.minimum), valueText(*gate.maximum));
  }
  if (gate.maximum) return fmt::format("≤ {}", valueText(*gate.maximum));
  if (gate.minimum) return fmt::format("≥ {}", valueText(*gate.minimum));
  return "no limit";
}

std::string gateName(const Gate& gate) {
  return nameWith(gate, limitText(gate));
}

std::string gateTitle(const Gate& gate) {
  return nameWith(gate, gate.minimum && gate.maximum ? "range" : gate.maximum ? "max" : "min");
}

std::string gateFaultText(const Judgement& judgement) {
  return fmt::format("{}: {}", gateName(judgement.gate), gateOutcome(judgement));
}

std::string gateOutcome(const Judgement& judgement) {
  const Gate& gate = judgement.gate;
  if (!judgement.value) {
    const bool skipped = judgement.verdict == GateVerdict::skipped;
    return (skipped ? "skipped: " : "undefined: ") + judgement.reason;
  }
  std::string text = valueText(*judgement.value);
  const std::optional<double> margin = judgement.margin();
  if (judgement.verdict == GateVerdict::failed && margin) {
    const bool large = gate.maximum && *judgement.value > *gate.maximum;
    text += fmt::format(", too {} by {:.3g}", large ? "large" : "small", std::abs(*margin));
  }
  if (const auto committed = committedValue(gate)) {
    text += fmt::format(", {} committed", valueText(*committed));
  }
  return text;
}

}  // namespace gnomon
