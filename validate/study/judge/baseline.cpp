#include "study/judge/baseline.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "common/error.h"
#include "compare/metric_range.h"
#include "compare/shadow_length.h"
#include "study/record/result_metrics.h"

namespace gnomon {
namespace {

constexpr std::string_view allRegion = "all";
constexpr double leastRateTolerance = 0.001;
constexpr double leastLengthTolerance = 0.02;

constexpr std::array<std::string_view, 5> metrics = {"error_rate", "false_shadow", "false_light",
                                                     "shadow_length_ratio", "prevalence"};

/// What one value is of.
using Key = std::tuple<std::string, std::string, std::string, std::string, std::string, Answer>;

Key keyOf(const BaselineEntry& entry) {
  return {entry.step, entry.method, entry.light, entry.view, entry.metric, entry.answer};
}

std::string textOf(const BaselineEntry& entry) {
  return fmt::format("{} of {}, {}, {}, {}, {}", entry.metric, entry.method,
                     answerName(entry.answer), entry.light, entry.view, entry.step);
}

GateRecord gateFor(const BaselineEntry& entry) {
  GateRecord gate{GateKind::reference,
                  entry.step,
                  entry.method,
                  entry.light,
                  entry.view,
                  std::string(allRegion),
                  entry.metric,
                  {},
                  {},
                  {},
                  {},
                  {}};
  gate.expected = entry.value;
  gate.answer = entry.answer;
  if (entry.metric == "prevalence") {
    gate.minimum = entry.value - entry.tolerance;
    gate.maximum = entry.value + entry.tolerance;
  } else if (isLengthMetric(entry.metric)) {
    const double distance = std::abs(entry.value - 1) + entry.tolerance;
    gate.minimum = 1 - distance;
    gate.maximum = 1 + distance;
  } else {
    gate.maximum = entry.value + entry.tolerance;
  }
  return gate;
}

/// The row that an entry speaks of.
const ResultRecord* rowOf(std::span<const StudyRecord> steps, const BaselineEntry& entry) {
  for (const StudyRecord& step : steps) {
    if (step.name != entry.step) continue;
    for (const ResultRecord& row : step.results) {
      if (row.method == entry.method && row.light == entry.light && row.view == entry.view &&
          row.region == allRegion && row.answer == entry.answer) {
        return &row;
      }
    }
  }
  return nullptr;
}

/// Why the method of an entry was not measured; null where it was.
const RefusedMethod* refusedIn(std::span<const StudyRecord> steps, const BaselineEntry& entry) {
  for (const StudyRecord& step : steps) {
    if (step.name != entry.step) continue;
    for (const RefusedMethod& method : step.refused) {
      if (method.label == entry.method) return &method;
    }
  }
  return nullptr;
}

[[noreturn]] void mismatch(const std::string& what, const std::vector<BaselineEntry>& entries) {
  throw InputError(fmt::format(
      "{} for {}{}", what, textOf(entries.front()),
      entries.size() == 1 ? std::string() : fmt::format(" and {} more", entries.size() - 1)));
}

void requireReferences(const Baseline& baseline, std::span<const StudyRecord> steps) {
  std::map<Key, bool> known;
  for (const BaselineEntry& entry : baseline.entries) known[keyOf(entry)] = true;
  std::vector<BaselineEntry> missing;
  for (const BaselineEntry& value : referenceValues(steps)) {
    if (!known.contains(keyOf(value))) missing.push_back(value);
  }
  if (!missing.empty()) mismatch("no reference", missing);
}

}  // namespace

std::span<const std::string_view> baselineMetrics(Answer answer) {
  constexpr std::size_t errorRates = 3;
  const std::span<const std::string_view> all = metrics;
  return answer == Answer::drawn ? all : all.first(errorRates);
}

bool isLengthMetric(std::string_view metric) {
  const auto& names = lengthMetricNames();
  return std::find(names.begin(), names.end(), metric) != names.end();
}

std::optional<double> spreadOf(const StudyRecord& record, const ResultRecord& result,
                               std::string_view metric) {
  const auto& flips = record.truth.flips;
  const auto found = std::find_if(flips.begin(), flips.end(), [&](const UncertaintyRecord& flip) {
    return flip.view == result.view && flip.light == result.light;
  });
  if (isRate(metric)) return found == flips.end() ? record.truth.uncertainty : found->flipRate;
  if (found == flips.end()) return std::nullopt;
  if (isLengthMetric(metric)) return found->lengthError;
  const double spread = metricUncertainty(*found, metric);
  return std::isfinite(spread) ? std::optional(spread) : std::nullopt;
}

double toleranceOf(std::string_view metric, double spread) {
  return std::max(2 * spread, isLengthMetric(metric) ? leastLengthTolerance : leastRateTolerance);
}

bool canFail(const BaselineEntry& entry) {
  // Lengths are over the truth's own: off by 1 is as good as no shadow at all.
  if (isLengthMetric(entry.metric)) return entry.tolerance < 1;
  const GateRecord gate = gateFor(entry);
  const MetricRange range = metricRange(entry.metric, {});
  return (gate.maximum && *gate.maximum < range.most) ||
         (gate.minimum && *gate.minimum > range.least);
}

std::vector<BaselineEntry> referenceValues(std::span<const StudyRecord> steps) {
  std::vector<BaselineEntry> entries;
  for (const StudyRecord& step : steps) {
    for (const ResultRecord& row : step.results) {
      if (row.region != allRegion) continue;
      for (const std::string_view metric : baselineMetrics(row.answer)) {
        const std::optional<double> value = metricOf(row, metric).value;
        const std::optional<double> spread = spreadOf(step, row, metric);
        if (!value || !spread) continue;
        const BaselineEntry entry{
            step.name,           row.method, row.light, row.view,
            std::string(metric), *value,     *spread,   toleranceOf(metric, *spread),
            row.answer};
        if (canFail(entry)) entries.push_back(entry);
      }
    }
  }
  return entries;
}

std::vector<GateRecord> judgeBaseline(const Baseline& baseline, std::span<const StudyRecord> steps,
                                      const std::vector<std::string>& leftOut) {
  std::vector<GateRecord> gates;
  std::vector<BaselineEntry> unknown;
  for (const BaselineEntry& entry : baseline.entries) {
    GateRecord gate = gateFor(entry);
    const ResultRecord* row = rowOf(steps, entry);
    if (std::find(leftOut.begin(), leftOut.end(), entry.method) != leftOut.end()) {
      gate.verdict = GateVerdict::skipped;
      gate.reason = "its method is left out";
    } else if (const RefusedMethod* refused = refusedIn(steps, entry)) {
      gate.reason = refused->reason;
    } else if (row == nullptr) {
      unknown.push_back(entry);
      continue;
    } else {
      const Metric metric = metricOf(*row, entry.metric);
      gate.value = metric.value;
      gate.reason = metric.reason;
      gate.verdict = verdictOf(gate);
    }
    gates.push_back(std::move(gate));
  }
  if (!unknown.empty()) mismatch("the run has no row", unknown);
  requireReferences(baseline, steps);
  return gates;
}

std::vector<NoticeRecord> betterThan(const Baseline& baseline,
                                     const std::vector<GateRecord>& gates) {
  std::map<Key, double> tolerances;
  for (const BaselineEntry& entry : baseline.entries) tolerances[keyOf(entry)] = entry.tolerance;
  std::vector<NoticeRecord> notices;
  for (const GateRecord& gate : gates) {
    if (gate.verdict != GateVerdict::passed || !gate.expected || gate.metric == "prevalence") {
      continue;
    }
    const bool length = isLengthMetric(gate.metric);
    const double gain = length ? std::abs(*gate.expected - 1) - std::abs(*gate.value - 1)
                               : *gate.expected - *gate.value;
    const double tolerance =
        tolerances.at({gate.step, gate.method, gate.light, gate.view, gate.metric, gate.answer});
    if (!(gain > tolerance)) continue;
    notices.push_back(
        {fmt::format("the reference of {} for {}, {}, {}, {} could be tightened: {:.5g} "
                     "now, {:.5g} committed, better by more than {:.3g}",
                     gate.metric, gate.method, gate.light, gate.view, gate.step, *gate.value,
                     *gate.expected, tolerance)});
  }
  return notices;
}

}  // namespace gnomon
