#include "report/text/gate_text.h"

#include <fmt/core.h>

#include <cmath>

#include "common/overloaded.h"
#include "study/record/cases.h"

namespace gnomon::report {
namespace {

std::string anyOr(const std::string& name, const char* kind) {
  return name.empty() ? fmt::format("any {}", kind) : name;
}

/// Enough digits to tell a value from its limit.
std::string valueText(double value) {
  return fmt::format("{:.6g}", value);
}

std::string nameWith(const study::Gate& gate, const std::string& limit) {
  std::string name = fmt::format("{}, {} {}, {}, {}", anyOr(gate.method, "method"), gate.metric,
                                 limit, anyOr(gate.view, "view"), anyOr(gate.light, "light"));
  if (gate.region != study::wholeRegion) name += ", region " + gate.region;
  if (gate.answer != study::Answer::drawn)
    name += fmt::format(", answer {}", study::answerName(gate.answer));
  const std::string value = study::stepValue(gate.step);
  return value.empty() ? name : name + ", at " + value;
}

}  // namespace

std::string gateVerdictName(study::GateVerdict verdict) {
  switch (verdict) {
    case study::GateVerdict::passed:
      return "pass";
    case study::GateVerdict::failed:
      return "fail";
    case study::GateVerdict::undefined:
      return "undefined";
    case study::GateVerdict::skipped:
      return "skipped";
  }
  throw InternalError("gate: a verdict that has no name");
}

std::string gateOriginName(const study::Gate& gate) {
  return std::visit(Overloaded{[](const study::Threshold&) { return "threshold"; },
                               [](const study::Reference&) { return "reference"; },
                               [](const study::CompareOption&) { return "option"; }},
                    gate.origin);
}

GatePlace gatePlace(const study::CheckRecord& check, const study::Gate& gate) {
  return std::visit(Overloaded{[&](const study::Threshold& threshold) {
                                 return GatePlace{check.file, threshold.line};
                               },
                               [&](const study::Reference&) { return GatePlace{check.baseline}; },
                               [](const study::CompareOption&) { return GatePlace{}; }},
                    gate.origin);
}

GatePlace faultPlace(const study::CheckRecord& check, const study::Gate& gate) {
  const auto shader = check.shaders.find(gate.method);
  return shader == check.shaders.end() ? gatePlace(check, gate) : GatePlace{shader->second};
}

std::string limitText(const study::Gate& gate) {
  if (gate.minimum && gate.maximum) {
    return fmt::format("{} to {}", valueText(*gate.minimum), valueText(*gate.maximum));
  }
  if (gate.maximum) return fmt::format("≤ {}", valueText(*gate.maximum));
  if (gate.minimum) return fmt::format("≥ {}", valueText(*gate.minimum));
  return "no limit";
}

std::string gateName(const study::Gate& gate) {
  return nameWith(gate, limitText(gate));
}

std::string gateTitle(const study::Gate& gate) {
  return nameWith(gate, gate.minimum && gate.maximum ? "range" : gate.maximum ? "max" : "min");
}

std::string gateFaultText(const study::Judgement& judgement) {
  return fmt::format("{}: {}", gateName(judgement.gate), gateOutcome(judgement));
}

std::string gateOutcome(const study::Judgement& judgement) {
  const study::Gate& gate = judgement.gate;
  if (!judgement.value) {
    const bool skipped = judgement.verdict == study::GateVerdict::skipped;
    return (skipped ? "skipped: " : "undefined: ") + judgement.reason;
  }
  std::string text = valueText(*judgement.value);
  const std::optional<double> margin = judgement.margin();
  if (judgement.verdict == study::GateVerdict::failed && margin) {
    const bool large = gate.maximum && *judgement.value > *gate.maximum;
    text += fmt::format(", too {} by {:.3g}", large ? "large" : "small", std::abs(*margin));
  }
  if (const auto committed = study::committedValue(gate)) {
    text += fmt::format(", {} committed", valueText(*committed));
  }
  return text;
}

}  // namespace gnomon::report
