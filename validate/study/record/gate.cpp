#include "study/record/gate.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/lists.h"

namespace gnomon::study {

std::string_view answerName(Answer answer) {
  return answer == Answer::drawn ? "drawn" : "test";
}

std::optional<Answer> answerOfName(std::string_view name) {
  for (const Answer answer : allAnswers) {
    if (answerName(answer) == name) return answer;
  }
  return std::nullopt;
}

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

namespace {

std::string quartilesText(const ClaimSpread& spread) {
  if (!spread.quartiles) return "";
  const Quartiles& q = *spread.quartiles;
  std::string text = fmt::format("; {} {:.2f}", spread.quantity, q.median);
  if (spread.cases < 2) return text;
  text += fmt::format(" ({:.2f} to {:.2f}", q.least, q.most);
  if (spread.cases >= 4) text += fmt::format(", quartiles {:.2f} and {:.2f}", q.first, q.third);
  return text + ")";
}

/// "holds for all lights together; ", where that was judged.
std::string togetherText(const ClaimSpread& spread, const char* unit) {
  if (!spread.together) return "";
  const std::string_view verdict = *spread.together == Verdict::held ? "holds"
                                   : *spread.together == Verdict::failed
                                       ? "fails"
                                       : verdictName(*spread.together);
  return fmt::format("{} for all {}s together; ", verdict, unit);
}

}  // namespace

std::string_view verdictName(Verdict verdict) {
  switch (verdict) {
    case Verdict::held:
      return "held";
    case Verdict::failed:
      return "failed";
    case Verdict::equal:
      return "equal";
    case Verdict::notDistinguishable:
      return "not distinguishable";
    case Verdict::noInterval:
      return "no interval";
    case Verdict::notEvaluated:
      return "not evaluated";
  }
  throw InternalError("verdict: not one of its six values");
}

std::optional<Quartiles> quartilesOf(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  return Quartiles{values.front(), quantile(values, 0.25), quantile(values, 0.5),
                   quantile(values, 0.75), values.back()};
}

std::string spreadText(const ClaimSpread& spread) {
  const bool ofLights = spread.views == 1;
  const char* where = ofLights ? "under" : "in";
  const char* unit = ofLights ? "light" : "case";
  const auto some = [&](Verdict verdict, std::size_t count) {
    return count == 0 ? "" : fmt::format(", {} {} {}", verdictName(verdict), where, count);
  };
  return fmt::format("{}holds {} {} of {} {}{}, fails {} {}{}{}{}", togetherText(spread, unit),
                     where, spread.held, spread.cases, unit, spread.cases == 1 ? "" : "s", where,
                     spread.failed, some(Verdict::equal, spread.equal),
                     some(Verdict::noInterval, spread.withoutInterval), quartilesText(spread));
}

}  // namespace gnomon::study
