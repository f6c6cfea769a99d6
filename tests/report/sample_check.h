#pragma once

#include <string>
#include <vector>

#include "study/record/gate_record.h"

namespace gnomon::test {

inline GateRecord sampleGate(GateVerdict verdict, std::optional<double> value, double maximum,
                             const std::string& method = "a") {
  GateRecord gate;
  gate.step = "sample";
  gate.method = method;
  gate.light = "elevation 30° azimuth 20°";
  gate.view = "camera";
  gate.region = "all";
  gate.metric = "error_rate";
  gate.value = value;
  gate.maximum = maximum;
  gate.verdict = verdict;
  gate.line = 12;
  return gate;
}

/// One gate of each verdict, a reference that fails, a problem and a notice. The text holds what
/// writers must escape.
inline CheckRecord sampleCheck() {
  CheckRecord check;
  check.name = "sample";
  check.file = "scenes/sample.toml";
  check.command = "gnomon check scenes/sample.toml --method 'a, \"b\" & <c>'";
  check.seconds = 1.5;
  check.baseline = "reference/sample.json";
  check.gates = {sampleGate(GateVerdict::passed, 0.02, 0.03),
                 sampleGate(GateVerdict::failed, 0.0512, 0.03, "a, \"b\" & <c>"),
                 sampleGate(GateVerdict::undefined, {}, 0.04),
                 sampleGate(GateVerdict::skipped, {}, 0.05)};
  check.gates.at(2).reason = "no samples";
  check.gates.at(3).reason = "its method is left out";
  check.gates.push_back(sampleGate(GateVerdict::failed, 0.09, 0.08));
  check.gates.back().kind = GateKind::reference;
  check.gates.back().expected = 0.07;
  check.gates.back().line = 0;
  check.problems = {{"baseline", ExitStatus::badInput, "scenes/sample.toml:7: 100 %\nwrong"}};
  check.notices = {{"the limit on x could be tightened", 30}};
  return check;
}

/// A check that passed.
inline CheckRecord passedCheck() {
  CheckRecord check;
  check.name = "good";
  check.file = "scenes/good.toml";
  check.command = "gnomon check scenes/good.toml";
  check.seconds = 0.25;
  check.gates = {sampleGate(GateVerdict::passed, 0.02, 0.03)};
  return check;
}

}  // namespace gnomon::test
