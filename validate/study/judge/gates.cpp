#include "study/judge/gates.h"

#include <fmt/core.h>

#include <cmath>
#include <utility>

#include "common/error.h"
#include "study/record/result_metrics.h"

namespace gnomon::study {
namespace {

bool matches(const std::string& filter, const std::string& name) {
  return filter.empty() || filter == name;
}

bool matches(const Gate& gate, const ResultRecord& row) {
  return matches(gate.method, row.method) && matches(gate.light, row.light) &&
         matches(gate.view, row.view) && matches(gate.region, row.region) &&
         gate.answer == row.answer;
}

/// With the names that it leaves free.
Gate gateOn(const ResultRecord& row, Gate gate, const std::string& step) {
  gate.method = row.method;
  gate.light = row.light;
  gate.view = row.view;
  gate.region = row.region;
  gate.step = step;
  return gate;
}

}  // namespace

Judgement judge(Gate gate, const compare::Metric& found) {
  if (!found.value) {
    return {std::move(gate), GateVerdict::undefined, {}, std::string(found.reason)};
  }
  const double value = *found.value;
  if (!std::isfinite(value)) {
    return {std::move(gate), GateVerdict::undefined, {}, "it is not a finite number"};
  }
  const bool holds = (gate.minimum || gate.maximum) && (!gate.minimum || *gate.minimum <= value) &&
                     (!gate.maximum || value <= *gate.maximum);
  return {std::move(gate), holds ? GateVerdict::passed : GateVerdict::failed, value};
}

std::vector<Judgement> judgeThresholds(std::span<const Gate> thresholds,
                                       const StudyRecord& record) {
  std::vector<Judgement> judgements;
  for (const Gate& gate : thresholds) {
    const std::size_t before = judgements.size();
    for (const ResultRecord& row : record.results) {
      if (!matches(gate, row)) continue;
      judgements.push_back(judge(gateOn(row, gate, record.name), metricOf(row, gate.metric)));
    }
    if (judgements.size() > before) continue;
    const int line = std::get<Threshold>(gate.origin).line;
    throw InputError(fmt::format("threshold on {} of \"{}\": no result matches it{}",
                                 gate.metric.name(), gate.method,
                                 line > 0 ? fmt::format(" (line {})", line) : ""));
  }
  return judgements;
}

}  // namespace gnomon::study
