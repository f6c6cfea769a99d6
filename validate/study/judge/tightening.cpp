#include "study/judge/tightening.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "study/judge/baseline.h"

namespace gnomon::study {
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
