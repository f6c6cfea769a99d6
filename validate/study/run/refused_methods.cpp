#include "study/run/refused_methods.h"

#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <utility>

#include "common/lists.h"
#include "study/spec/study_reduction.h"

namespace gnomon::study {
namespace {

bool speaksOf(const std::string& filter, const std::string& name) {
  return filter.empty() || filter == name;
}

/// The gates of one refused method, one for each view and light.
void addGates(StudyRecord& record, const StudySpec& study, const RefusedMethod& method) {
  for (const Gate& gate : study.thresholds) {
    if (!speaksOf(gate.method, method.label)) continue;
    for (const ViewSpec& view : study.views) {
      for (const Light& light : study.lights) {
        if (!speaksOf(gate.view, view.name) || !speaksOf(gate.light, light.name)) continue;
        Gate row = gate;
        row.method = method.label;
        row.view = view.name;
        row.light = light.name;
        row.step = record.name;
        record.judgements.push_back({std::move(row), GateVerdict::undefined, {}, method.reason});
      }
    }
  }
}

}  // namespace

MeasurableStudy measurable(const StudySpec& study, DriverFaults& faults) {
  faults.requireViews(study);
  MeasurableStudy left;
  std::vector<std::string> labels;
  const bool isSoft = std::any_of(study.lights.begin(), study.lights.end(),
                                  [](const Light& light) { return light.isSoft(); });
  for (const MethodSpec& method : study.methods) {
    std::string fault = faults.faultOf(method, isSoft);
    if (fault.empty()) continue;
    labels.push_back(method.label);
    left.refused.push_back({method.label, std::move(fault)});
  }
  if (!study.methods.empty() && labels.size() == study.methods.size()) {
    throw DriverError(fmt::format("nothing is measured: {}", left.refused.front().reason));
  }
  const auto isWrong = [&](const MethodSpec& state) {
    return !faults.faultOf(state, isSoft).empty();
  };
  for (const LadderSpec& ladder : study.ladders) {
    const auto state = std::find_if(ladder.forward.begin(), ladder.forward.end(), isWrong);
    const auto other = std::find_if(ladder.backward.begin(), ladder.backward.end(), isWrong);
    if (state == ladder.forward.end() && other == ladder.backward.end()) continue;
    if (contains(labels, ladder.method)) continue;
    const MethodSpec& wrong = state != ladder.forward.end() ? *state : *other;
    throw DriverError(fmt::format("the ladder of {} is not measured: {}", ladder.method,
                                  faults.faultOf(wrong, isSoft)));
  }
  if (!labels.empty()) left.reduced = withoutMethods(study, labels);
  return left;
}

void addRefused(StudyRecord& record, const StudySpec& study,
                const std::vector<RefusedMethod>& refused) {
  record.refused = refused;
  std::vector<std::string> texts;
  for (const RefusedMethod& method : refused) {
    texts.push_back(fmt::format("{} is not measured: {}", method.label, method.reason));
    record.problems.push_back({"method", ExitStatus::internal, texts.back()});
    addGates(record, study, method);
  }
  record.notices.insert(record.notices.begin(), texts.begin(), texts.end());
}

}  // namespace gnomon::study
