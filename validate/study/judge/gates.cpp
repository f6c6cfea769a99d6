#include "study/judge/gates.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "common/error.h"
#include "study/judge/baseline.h"
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

}  // namespace gnomon::study
