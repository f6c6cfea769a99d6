#include "study/record/gate_record.h"

#include <algorithm>

namespace gnomon {

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

std::vector<GateRecord> gatesOf(const StudyRecord& record) {
  std::vector<GateRecord> gates;
  for (const ThresholdRecord& threshold : record.thresholds) {
    gates.push_back(gateOf(threshold, record.name));
  }
  gates.insert(gates.end(), record.references.begin(), record.references.end());
  return gates;
}

ExitStatus CheckRecord::status() const {
  if (runStatus(gates, problems) == RunStatus::pass) return ExitStatus::pass;
  return std::max(ExitStatus::thresholdFailed, worstOf(problems));
}

}  // namespace gnomon
