#include "study/judge/gates.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "common/error.h"
#include "common/lists.h"
#include "compare/metric.h"
#include "compare/shadow_length.h"

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

namespace {

constexpr double looseShare = 0.25;
constexpr double looseTolerances = 4;

/// What all rows of one gate leave free.
struct Room {
  double below = std::numeric_limits<double>::infinity();  ///< the maximum
  double above = std::numeric_limits<double>::infinity();  ///< the minimum
  double tolerance = 0;
};

/// None, where a row did not pass.
std::optional<Room> roomOf(const Gate& gate, std::span<const StudyRecord> steps) {
  Room room;
  for (const StudyRecord& step : steps) {
    for (const Judgement& row : step.judgements) {
      if (row.gate.origin != gate.origin) continue;
      if (row.verdict != GateVerdict::passed) return std::nullopt;
      const auto spread = spreadOf(step, {row.gate.view, row.gate.light}, gate.metric);
      if (gate.maximum) room.below = std::min(room.below, *gate.maximum - *row.value);
      if (gate.minimum) room.above = std::min(room.above, *row.value - *gate.minimum);
      room.tolerance = std::max(room.tolerance, toleranceOf(gate.metric, spread.value_or(0)));
    }
  }
  return room;
}

bool isLoose(double limit, double room, double tolerance) {
  return std::isfinite(room) && room > looseShare * std::abs(limit) &&
         room > looseTolerances * tolerance;
}

NoticeRecord notice(const Gate& gate, const char* side, double limit, double value) {
  return {fmt::format("the limit on {} of {} could be tightened: {} {} allowed, {:.5g} the nearest "
                      "value",
                      gate.metric.name(), gate.method.empty() ? "all methods" : gate.method, side,
                      limit, value),
          std::get<Threshold>(gate.origin).line};
}

}  // namespace

std::vector<NoticeRecord> looseThresholds(std::span<const Gate> thresholds,
                                          std::span<const StudyRecord> steps) {
  std::vector<NoticeRecord> notices;
  for (const Gate& gate : thresholds) {
    const std::optional<Room> room = roomOf(gate, steps);
    if (!room) continue;
    if (gate.maximum && isLoose(*gate.maximum, room->below, room->tolerance)) {
      notices.push_back(notice(gate, "at most", *gate.maximum, *gate.maximum - room->below));
    }
    if (gate.minimum && isLoose(*gate.minimum, room->above, room->tolerance)) {
      notices.push_back(notice(gate, "at least", *gate.minimum, *gate.minimum + room->above));
    }
  }
  return notices;
}

namespace {

constexpr std::array<compare::MetricId, 5> committedMetrics = {
    "error_rate", "false_shadow", "false_light", "shadow_length_ratio", "prevalence"};

bool isLength(compare::MetricId metric) {
  return metric.kind() == compare::MetricKind::length;
}

[[noreturn]] void mismatch(const char* what, const std::vector<Gate>& gates) {
  const Gate& first = gates.front();
  throw InputError(fmt::format(
      "{} for {} of {}, {}, {}, {}, {}{}", what, first.metric.name(), first.method,
      answerName(first.answer), first.light, first.view, first.step,
      gates.size() == 1 ? std::string() : fmt::format(" and {} more", gates.size() - 1)));
}

/// @throws InputError where the run has a value without a reference
void requireReferences(std::span<const Gate> references, const StudyRecord& record) {
  std::set<decltype(valueKey(Gate()))> known;
  for (const Gate& reference : references) known.insert(valueKey(reference));
  std::vector<Gate> missing = referenceGates({&record, 1});
  std::erase_if(missing, [&](const Gate& value) { return known.contains(valueKey(value)); });
  if (!missing.empty()) mismatch("no reference", missing);
}

/// Why a method was not measured; nullptr where it was.
const RefusedMethod* refusedIn(const StudyRecord& record, const std::string& label) {
  const auto found =
      std::find_if(record.refused.begin(), record.refused.end(),
                   [&](const RefusedMethod& method) { return method.label == label; });
  return found == record.refused.end() ? nullptr : &*found;
}

}  // namespace

std::span<const compare::MetricId> baselineMetrics(Answer answer) {
  constexpr std::size_t errorRates = 3;
  const std::span<const compare::MetricId> all = committedMetrics;
  return answer == Answer::drawn ? all : all.first(errorRates);
}

std::optional<double> spreadOf(const StudyRecord& record, const Case& which,
                               compare::MetricId metric) {
  const UncertaintyRecord* found = findUncertainty(record, which);
  if (metric.kind() == compare::MetricKind::rate)
    return found == nullptr ? record.truth.uncertainty : found->flipRate;
  if (found == nullptr) return std::nullopt;
  if (isLength(metric)) return found->lengthError;
  const double spread = metricUncertainty(*found, metric);
  return std::isfinite(spread) ? std::optional(spread) : std::nullopt;
}

double toleranceOf(compare::MetricId metric, double spread) {
  return std::max(2 * spread, isLength(metric) ? leastLengthTolerance : leastRateTolerance);
}

Gate referenceGate(Gate row, const Reference& reference) {
  const auto [committed, spread, tolerance] = reference;
  row.region = wholeRegion;
  row.origin = reference;
  if (row.metric == compare::metrics::prevalence) {
    row.minimum = committed - tolerance;
    row.maximum = committed + tolerance;
  } else if (isLength(row.metric)) {
    const double distance = std::abs(committed - 1) + tolerance;
    row.minimum = 1 - distance;
    row.maximum = 1 + distance;
  } else {
    row.maximum = committed + tolerance;
  }
  return row;
}

const Reference& referenceOf(const Gate& gate) {
  return std::get<Reference>(gate.origin);
}

bool canFail(const Gate& reference) {
  // Lengths are over the truth's own: off by 1 is as good as no shadow at all.
  if (isLength(reference.metric)) return referenceOf(reference).tolerance < 1;
  const compare::MetricRange range = compare::metricRange(reference.metric, {});
  return (reference.maximum && *reference.maximum < range.most) ||
         (reference.minimum && *reference.minimum > range.least);
}

std::vector<Gate> referenceGates(std::span<const StudyRecord> steps) {
  std::vector<Gate> gates;
  for (const StudyRecord& step : steps) {
    for (const ResultRecord& row : step.results) {
      if (row.region != wholeRegion) continue;
      for (const compare::MetricId metric : baselineMetrics(row.answer)) {
        const std::optional<double> value = metricOf(row, metric).value;
        const std::optional<double> spread = spreadOf(step, {row.view, row.light}, metric);
        if (!value || !spread) continue;
        Gate gate{row.method, row.light, row.view, "", metric, {}, {}};
        gate.answer = row.answer;
        gate.step = step.name;
        gate = referenceGate(std::move(gate), {*value, *spread, toleranceOf(metric, *spread)});
        if (canFail(gate)) gates.push_back(std::move(gate));
      }
    }
  }
  return gates;
}

std::vector<Judgement> judgeBaseline(const Baseline& baseline, const StudyRecord& record,
                                     const std::vector<std::string>& leftOut) {
  std::vector<Judgement> judgements;
  std::vector<Gate> unknown;
  for (const Gate& gate : baseline.gates) {
    if (gate.step != record.name) continue;
    const ResultRecord* row =
        findResult(record, gate.method, {gate.view, gate.light}, wholeRegion, gate.answer);
    if (contains(leftOut, gate.method)) {
      judgements.push_back({gate, GateVerdict::skipped, {}, "its method is left out"});
    } else if (const RefusedMethod* refused = refusedIn(record, gate.method)) {
      judgements.push_back({gate, GateVerdict::undefined, {}, refused->reason});
    } else if (row == nullptr) {
      unknown.push_back(gate);
    } else {
      judgements.push_back(judge(gate, metricOf(*row, gate.metric)));
    }
  }
  if (!unknown.empty()) mismatch("the run has no row", unknown);
  requireReferences(baseline.gates, record);
  return judgements;
}

std::vector<NoticeRecord> betterThan(std::span<const Judgement> references) {
  std::vector<NoticeRecord> notices;
  for (const Judgement& judgement : references) {
    const Gate& gate = judgement.gate;
    if (judgement.verdict != GateVerdict::passed || gate.metric == compare::metrics::prevalence)
      continue;
    const auto [committed, spread, tolerance] = referenceOf(gate);
    const double gain = isLength(gate.metric)
                            ? std::abs(committed - 1) - std::abs(*judgement.value - 1)
                            : committed - *judgement.value;
    if (!(gain > tolerance)) continue;
    notices.push_back(
        {fmt::format("the reference of {} for {}, {}, {}, {} could be tightened: {:.5g} "
                     "now, {:.5g} committed, better by more than {:.3g}",
                     gate.metric.name(), gate.method, gate.light, gate.view, gate.step,
                     *judgement.value, committed, tolerance)});
  }
  return notices;
}

}  // namespace gnomon::study
