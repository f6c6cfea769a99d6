#include "study/record/gate.h"

#include <algorithm>
#include <cmath>

namespace gnomon {

std::optional<double> GateRecord::margin() const {
  if (!value) return std::nullopt;
  std::optional<double> least;
  if (minimum) least = *value - *minimum;
  if (maximum) least = std::min(least.value_or(*maximum - *value), *maximum - *value);
  return least;
}

GateVerdict verdictOf(const GateRecord& gate) {
  if (!gate.value || !std::isfinite(*gate.value)) return GateVerdict::undefined;
  const bool bounded = gate.minimum || gate.maximum;
  const bool holds = (!gate.minimum || *gate.minimum <= *gate.value) &&
                     (!gate.maximum || *gate.value <= *gate.maximum);
  return bounded && holds ? GateVerdict::passed : GateVerdict::failed;
}

ExitStatus worstOf(std::span<const ProblemRecord> problems) {
  ExitStatus worst = ExitStatus::pass;
  for (const ProblemRecord& problem : problems) worst = std::max(worst, problem.status);
  return worst;
}

RunStatus runStatus(std::span<const GateRecord> gates, std::span<const ProblemRecord> problems) {
  const auto isPassed = [](const GateRecord& gate) { return gate.verdict == GateVerdict::passed; };
  const auto isFault = [](const GateRecord& gate) {
    return gate.verdict == GateVerdict::failed || gate.verdict == GateVerdict::undefined;
  };
  if (!problems.empty() || std::any_of(gates.begin(), gates.end(), isFault)) return RunStatus::fail;
  const bool any = std::any_of(gates.begin(), gates.end(), isPassed);
  return any ? RunStatus::pass : RunStatus::notJudged;
}

}  // namespace gnomon
