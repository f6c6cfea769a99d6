#pragma once

#include <string>
#include <vector>

#include "study/record/cases.h"

namespace gnomon::test {

inline study::Judgement sampleJudgement(study::GateVerdict verdict, std::optional<double> value,
                                        double maximum, const std::string& method = "a",
                                        const std::string& reason = {}) {
  study::Gate gate{method, "elevation 30° azimuth 20°", "camera", "all", "error_rate", {}, maximum};
  gate.origin = study::Threshold{12};
  gate.step = "sample";
  return {gate, verdict, value, reason};
}

/// One gate of each verdict, a reference that fails, a problem and a notice. The text holds what
/// writers must escape.
inline study::CheckRecord sampleCheck() {
  study::CheckRecord check;
  check.name = "sample";
  check.file = "scenes/sample.toml";
  check.command = "gnomon check scenes/sample.toml --method 'a, \"b\" & <c>'";
  check.seconds = 1.5;
  check.baseline = "reference/sample.json";
  check.judgements = {
      sampleJudgement(study::GateVerdict::passed, 0.02, 0.03),
      sampleJudgement(study::GateVerdict::failed, 0.0512, 0.03, "a, \"b\" & <c>"),
      sampleJudgement(study::GateVerdict::undefined, {}, 0.04, "a", "no samples"),
      sampleJudgement(study::GateVerdict::skipped, {}, 0.05, "a", "its method is left out"),
      sampleJudgement(study::GateVerdict::failed, 0.09, 0.08)};
  check.judgements.back().gate.origin = study::Reference{0.07, 0.005, 0.01};
  check.problems = {{"baseline", ExitStatus::badInput, "scenes/sample.toml:7: 100 %\nwrong"}};
  check.notices = {{"the limit on x could be tightened", 30}};
  return check;
}

/// A check that passed.
inline study::CheckRecord passedCheck() {
  study::CheckRecord check;
  check.name = "good";
  check.file = "scenes/good.toml";
  check.command = "gnomon check scenes/good.toml";
  check.seconds = 0.25;
  check.judgements = {sampleJudgement(study::GateVerdict::passed, 0.02, 0.03)};
  return check;
}

}  // namespace gnomon::test
