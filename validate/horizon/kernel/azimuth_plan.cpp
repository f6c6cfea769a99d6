#include "horizon/kernel/azimuth_plan.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace gnomon::horizon {
namespace {

constexpr std::size_t groupTaps = AzimuthPlan::groupTaps;
constexpr std::size_t bundleTaps = groupTaps * AzimuthPlan::bundleGroups;

float toleranceAt(double r, const PaddedMap& map) {
  return static_cast<float>(map.tolerance / std::max(r, 1.0));
}

Tap tapOf(const Crossing& c, const PaddedMap& map) {
  return {map.offset(c.from),
          map.offset(c.to),
          static_cast<float>(c.share),
          static_cast<float>(c.leave),
          static_cast<float>(1 / c.leave),
          toleranceAt(c.leave, map)};
}

CellPath pathOf(Node cell, double enter, double leave, Vec2 e, const PaddedMap& map) {
  const double length = leave - enter;
  const double bend = -e.x * e.y;
  return {map.offset(cell),
          static_cast<float>(enter),
          static_cast<float>(length),
          static_cast<float>(enter > 0 ? 1 / enter : 0),
          static_cast<float>(enter * e.x - cell.x),
          static_cast<float>(enter * e.y - cell.y),
          static_cast<float>(bend),
          static_cast<float>(enter > 0 ? 0.25 * bend * length * length / enter : 0)};
}

/// In a cell of bend c the peak exceeds the slope at its end r₁ by c (r₁ - r)² / r₁.
double peakRoom(const Crossing& c, Vec2 e, const PaddedMap& map) {
  if (!(c.enter > 0)) return 0;
  const double bend = -e.x * e.y;
  const double most = std::max(bend * map.highestTwist, bend * map.lowestTwist);
  const double length = c.leave - c.enter;
  return most * length * length / c.leave;
}

/// A stretch with its box still at the ray's own nodes, and the size of that box.
struct Bounded {
  Stretch stretch;
  BoxSize box;
};

Bounded boundCrossings(std::span<const Crossing> crossings, Vec2 e, const PaddedMap& map) {
  Node low = crossings.front().cell;
  Node high = low;
  double room = 0;
  for (const Crossing& c : crossings) {
    low = {std::min(low.x, c.cell.x), std::min(low.y, c.cell.y)};
    high = {std::max(high.x, c.cell.x), std::max(high.y, c.cell.y)};
    room = std::max(room, peakRoom(c, e, map));
  }
  const double enter = crossings.front().enter;
  const double leave = crossings.back().leave;
  return {{low, static_cast<float>(enter), static_cast<float>(leave), static_cast<float>(room),
           toleranceAt(crossings.front().leave, map)},
          {high.x - low.x + 2, high.y - low.y + 2}};
}

/// Cuts a ray into stretches of so many taps, all bounded by boxes of one size.
BoxSize cutStretches(std::span<const Crossing> crossings, std::size_t taps, Vec2 e,
                     const PaddedMap& map, std::vector<Stretch>& stretches) {
  BoxSize box{2, 2};
  for (std::size_t begin = 0; begin < crossings.size(); begin += taps) {
    const std::size_t count = std::min(taps, crossings.size() - begin);
    const Bounded bounded = boundCrossings(crossings.subspan(begin, count), e, map);
    box = {std::max(box.width, bounded.box.width), std::max(box.height, bounded.box.height)};
    stretches.push_back(bounded.stretch);
    stretches.back().corner = map.folded(bounded.stretch.corner);
  }
  return box;
}

}  // namespace

AzimuthPlan planAzimuth(Vec2 direction, double radius, const PaddedMap& map) {
  const RayCrossings ray = cutRay(direction, radius);
  AzimuthPlan plan;
  plan.direction = direction;
  plan.radius = radius;
  for (const Crossing& c : ray.crossings) {
    plan.taps.push_back(tapOf(c, map));
    plan.cells.push_back(pathOf(c.cell, c.enter, c.leave, direction, map));
  }
  while (plan.taps.size() % groupTaps != 0) {
    plan.taps.push_back(plan.taps.back());
    plan.cells.push_back(plan.cells.back());
    plan.cells.back().quarterBulge = 0;
  }
  plan.groupBox = cutStretches(ray.crossings, groupTaps, direction, map, plan.groups);
  plan.bundleBox = cutStretches(ray.crossings, bundleTaps, direction, map, plan.bundles);
  plan.endsInCell = ray.lastEnter < radius;
  plan.lastCell = pathOf(ray.lastCell, ray.lastEnter, radius, direction, map);
  plan.end = {map.folded(ray.lastCell), static_cast<float>(ray.lastEnter),
              static_cast<float>(radius), 0, toleranceAt(radius, map)};
  return plan;
}

double azimuthPlanBytes(double radius) {
  // A ray crosses at most √2 D lattice lines.
  return (sizeof(Crossing) + sizeof(Tap) + sizeof(CellPath)) * (1.5 * radius + 2 + groupTaps);
}

}  // namespace gnomon::horizon
