#include "study/gate_record.h"

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

GateRecord gateOf(const ThresholdRecord& threshold, const std::string& step) {
  GateRecord gate{GateKind::threshold,
                  step,
                  threshold.method,
                  threshold.light,
                  threshold.view,
                  threshold.region,
                  threshold.metric,
                  threshold.value,
                  threshold.minimum,
                  threshold.maximum,
                  {},
                  threshold.reason,
                  threshold.line};
  gate.answer = threshold.answer;
  gate.verdict = verdictOf(gate);
  // What is not finite is no value.
  if (gate.verdict == GateVerdict::undefined && gate.value) {
    gate.value.reset();
    gate.reason = "it is not a finite number";
  }
  return gate;
}

GateRecord gateOf(const LeftOutThreshold& threshold, const std::string& step) {
  const ThresholdSpec& gate = threshold.gate;
  return {GateKind::threshold, step,         gate.method,          gate.light,
          gate.view,           gate.region,  gate.metric,          std::nullopt,
          gate.minimum,        gate.maximum, GateVerdict::skipped, threshold.reason,
          gate.line,           {},           gate.answer};
}

ExitStatus CheckRecord::status() const {
  ExitStatus worst = ExitStatus::pass;
  for (const ProblemRecord& problem : problems) worst = std::max(worst, problem.status);
  const auto isPassed = [](const GateRecord& g) { return g.verdict == GateVerdict::passed; };
  const auto isFine = [&](const GateRecord& g) {
    return isPassed(g) || g.verdict == GateVerdict::skipped;
  };
  const bool passed = std::any_of(gates.begin(), gates.end(), isPassed) &&
                      std::all_of(gates.begin(), gates.end(), isFine);
  return passed ? worst : std::max(worst, ExitStatus::thresholdFailed);
}

}  // namespace gnomon
