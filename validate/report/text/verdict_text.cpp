#include "report/text/verdict_text.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/lists.h"
#include "report/text/number_text.h"
#include "study/record/cases.h"

namespace gnomon::report {

std::string fewerCasesText(std::size_t cases, std::size_t allCases, const std::string& best,
                           std::optional<double> leaderError) {
  std::string text = fmt::format("in {} of {} cases: no rank", cases, allCases);
  if (!leaderError) return text;
  return fmt::format("{}; {} has {} % on the same", text, best, percentText(leaderError));
}

std::string quotedText(const std::string& label) {
  return "“" + label + "”";
}

std::string listText(const std::vector<std::string>& labels) {
  constexpr std::size_t most = 3;
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < std::min(most, labels.size()); ++i) {
    parts.push_back(quotedText(labels[i]));
  }
  if (labels.size() > most) parts.push_back(fmt::format("{} more", labels.size() - most));
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) text += i + 1 == parts.size() ? " and " : ", ";
    text += parts[i];
  }
  return text;
}

std::string_view differenceSign(study::DifferenceVerdict verdict) {
  switch (verdict) {
    case study::DifferenceVerdict::equal:
      return " =";
    case study::DifferenceVerdict::notDistinguishable:
      return " ≈";
    case study::DifferenceVerdict::noInterval:
      return " ?";
    default:
      return "";
  }
}

std::string likeText(const study::LikeMethods& methods) {
  std::vector<std::string> parts;
  const auto add = [&](const char* what, const std::vector<std::string>& labels) {
    if (!labels.empty()) parts.push_back(what + listText(labels));
  };
  add("the same answers as ", methods.equal);
  add("not distinguishable from ", methods.close);
  add("no interval of the difference from ", methods.withoutInterval);
  return fmt::format("{}", fmt::join(parts, "; "));
}

std::vector<std::string> noIntervalNotes(const std::vector<study::DifferenceRecord>& toBest) {
  std::vector<std::pair<std::string, std::vector<std::string>>> byReason;
  for (const study::DifferenceRecord& difference : toBest) {
    if (difference.verdict != study::DifferenceVerdict::noInterval) continue;
    auto found = std::find_if(byReason.begin(), byReason.end(), [&](const auto& reason) {
      return reason.first == difference.reason;
    });
    if (found == byReason.end()) found = byReason.insert(found, {difference.reason, {}});
    appendOnce(found->second, difference.first);
  }
  std::vector<std::string> notes;
  for (const auto& [reason, labels] : byReason) {
    notes.push_back(
        fmt::format("? No interval of the difference of {}: {}.", listText(labels), reason));
  }
  return notes;
}

namespace {

std::string anyOr(const std::string& name, const char* kind) {
  return name.empty() ? fmt::format("any {}", kind) : name;
}

/// @param decimals  none for as many digits as a limit is written with
std::string valueText(double value, std::optional<int> decimals) {
  constexpr double large = 1e6;  // lengths in samples, say
  if (!decimals || std::abs(value) >= large) return fmt::format("{:.6g}", value);
  return fmt::format("{:.{}f}", value, *decimals);
}

/// Decimals of all numbers that are told of a fault: three digits of what it is off by, 4 at least.
std::optional<int> decimalsOf(const study::Judgement& judgement) {
  const std::optional<double> margin = judgement.margin();
  if (!margin || *margin == 0) return std::nullopt;
  constexpr int fewest = 4, most = 9;
  return std::clamp(2 - static_cast<int>(std::floor(std::log10(std::abs(*margin)))), fewest, most);
}

std::string nameWith(const study::Gate& gate, const std::string& limit) {
  std::string name =
      fmt::format("{}, {} {}, {}, {}", anyOr(gate.method, "method"), gate.metric.name(), limit,
                  anyOr(gate.view, "view"), anyOr(gate.light, "light"));
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

std::string limitText(const study::Gate& gate, std::optional<int> decimals) {
  if (gate.minimum && gate.maximum) {
    return fmt::format("{} to {}", valueText(*gate.minimum, decimals),
                       valueText(*gate.maximum, decimals));
  }
  if (gate.maximum) return fmt::format("≤ {}", valueText(*gate.maximum, decimals));
  if (gate.minimum) return fmt::format("≥ {}", valueText(*gate.minimum, decimals));
  return "no limit";
}

std::string gateName(const study::Gate& gate) {
  return nameWith(gate, limitText(gate));
}

std::string gateTitle(const study::Gate& gate) {
  return nameWith(gate, gate.minimum && gate.maximum ? "range" : gate.maximum ? "max" : "min");
}

std::string gateFaultText(const study::Judgement& judgement) {
  const std::string limit = limitText(judgement.gate, decimalsOf(judgement));
  return fmt::format("{}: {}", nameWith(judgement.gate, limit), gateOutcome(judgement));
}

std::string gateOutcome(const study::Judgement& judgement) {
  const study::Gate& gate = judgement.gate;
  if (!judgement.value) {
    const bool skipped = judgement.verdict == study::GateVerdict::skipped;
    return (skipped ? "skipped: " : "undefined: ") + judgement.reason;
  }
  const std::optional<double> margin = judgement.margin();
  const std::optional<int> decimals = decimalsOf(judgement);
  std::string text = valueText(*judgement.value, decimals);
  if (judgement.verdict == study::GateVerdict::failed && margin) {
    const bool large = gate.maximum && *judgement.value > *gate.maximum;
    text += fmt::format(", too {} by {}", large ? "large" : "small",
                        valueText(std::abs(*margin), decimals));
  }
  if (const auto committed = study::committedValue(gate)) {
    text += fmt::format(", {} committed", valueText(*committed, decimals));
  }
  return text;
}

}  // namespace gnomon::report
