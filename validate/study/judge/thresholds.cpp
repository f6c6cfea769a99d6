#include "study/judge/thresholds.h"

#include <fmt/core.h>

#include "common/error.h"
#include "study/record/gate_record.h"
#include "study/record/result_metrics.h"

namespace gnomon {
namespace {

bool matches(const std::string& filter, const std::string& name) {
  return filter.empty() || filter == name;
}

ThresholdRecord judge(const ThresholdSpec& gate, const ResultRecord& result) {
  ThresholdRecord record{result.method, result.light, result.view,  result.region, gate.metric,
                         std::nullopt,  gate.minimum, gate.maximum, false};
  const Metric metric = metricOf(result, gate.metric);
  record.value = metric.value;
  record.reason = metric.reason;
  record.line = gate.line;
  record.answer = gate.answer;
  record.passed = gateOf(record, "").verdict == GateVerdict::passed;
  return record;
}

}  // namespace

std::vector<ThresholdRecord> judgeThresholds(const std::vector<ThresholdSpec>& thresholds,
                                             const std::vector<ResultRecord>& results) {
  std::vector<ThresholdRecord> records;
  for (const ThresholdSpec& gate : thresholds) {
    const std::size_t before = records.size();
    for (const ResultRecord& result : results) {
      if (matches(gate.method, result.method) && matches(gate.light, result.light) &&
          matches(gate.view, result.view) && matches(gate.region, result.region) &&
          gate.answer == result.answer) {
        records.push_back(judge(gate, result));
      }
    }
    if (records.size() == before) {
      throw InputError(fmt::format("threshold on {} of \"{}\": no result matches it{}", gate.metric,
                                   gate.method,
                                   gate.line > 0 ? fmt::format(" (line {})", gate.line) : ""));
    }
  }
  return records;
}

GateRecord gateOf(const LeftOutThreshold& threshold, const std::string& step) {
  const ThresholdSpec& gate = threshold.gate;
  return {GateKind::threshold, step,         gate.method,          gate.light,
          gate.view,           gate.region,  gate.metric,          std::nullopt,
          gate.minimum,        gate.maximum, GateVerdict::skipped, threshold.reason,
          gate.line,           {},           gate.answer};
}

}  // namespace gnomon
