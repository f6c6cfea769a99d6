#include "study/record/gate.h"

#include <algorithm>

#include "common/overloaded.h"

namespace gnomon::study {

std::optional<double> Judgement::margin() const {
  if (!value) return std::nullopt;
  std::optional<double> least;
  if (gate.minimum) least = *value - *gate.minimum;
  if (gate.maximum) {
    const double below = *gate.maximum - *value;
    least = std::min(least.value_or(below), below);
  }
  return least;
}

bool Judgement::isFault() const {
  return verdict == GateVerdict::failed || verdict == GateVerdict::undefined;
}

std::string stepValue(const std::string& step) {
  const std::size_t slash = step.find('/');
  return slash == std::string::npos ? "" : step.substr(slash + 1);
}

std::optional<double> committedValue(const Gate& gate) {
  using Value = std::optional<double>;
  return std::visit(
      Overloaded{[](const Threshold&) -> Value { return std::nullopt; },
                 [](const Reference& reference) -> Value { return reference.committed; },
                 [](const CompareOption&) -> Value { return std::nullopt; }},
      gate.origin);
}

JudgementsByOrigin byOrigin(std::span<const Judgement> judgements) {
  JudgementsByOrigin lists;
  for (const Judgement& judgement : judgements) {
    std::visit(Overloaded{[&](const Threshold&) { lists.thresholds.push_back(judgement); },
                          [&](const Reference&) { lists.references.push_back(judgement); },
                          [&](const CompareOption&) { lists.options.push_back(judgement); }},
               judgement.gate.origin);
  }
  return lists;
}

ExitStatus worstOf(std::span<const ProblemRecord> problems) {
  ExitStatus worst = ExitStatus::pass;
  for (const ProblemRecord& problem : problems) worst = std::max(worst, problem.status);
  return worst;
}

RunStatus runStatus(std::span<const Judgement> judgements,
                    std::span<const ProblemRecord> problems) {
  const auto isFault = [](const Judgement& judgement) { return judgement.isFault(); };
  const auto isPassed = [](const Judgement& judgement) {
    return judgement.verdict == GateVerdict::passed;
  };
  if (!problems.empty() || std::any_of(judgements.begin(), judgements.end(), isFault)) {
    return RunStatus::fail;
  }
  const bool any = std::any_of(judgements.begin(), judgements.end(), isPassed);
  return any ? RunStatus::pass : RunStatus::notJudged;
}

}  // namespace gnomon::study
