#include "relief/azimuth_plan.h"

#include <algorithm>
#include <limits>

namespace gnomon {
namespace {

constexpr std::size_t groupSize = 16;

Tap tapOf(const Crossing& c, Vec2 e, const PaddedMap& map) {
  const auto offset = [&](Node n) { return n.y * map.stride + n.x; };
  const double within = c.leave - c.enter;
  // In the first cell the slope A + C r has no extremum.
  const double bulge = c.enter > 0 ? -e.x * e.y * within * within / c.enter : 0;
  return {offset(c.from),
          offset(c.to),
          offset(c.cell),
          static_cast<float>(c.share),
          static_cast<float>(c.leave),
          static_cast<float>(1 / c.leave),
          static_cast<float>(map.tolerance / c.leave),
          static_cast<float>(0.25 * bulge)};
}

TapGroup emptyGroup(std::size_t begin, std::size_t end, double enter, double leave) {
  constexpr std::ptrdiff_t most = std::numeric_limits<std::ptrdiff_t>::max();
  return {begin,
          end,
          static_cast<float>(1 / enter),
          static_cast<float>(1 / leave),
          {most, most, -most, -most}};
}

void cover(TexelBox& box, Node cell) {
  box.left = std::min<std::ptrdiff_t>(box.left, cell.x);
  box.bottom = std::min<std::ptrdiff_t>(box.bottom, cell.y);
  box.right = std::max<std::ptrdiff_t>(box.right, cell.x + 1);
  box.top = std::max<std::ptrdiff_t>(box.top, cell.y + 1);
}

std::vector<TapGroup> groupCrossings(const std::vector<Crossing>& crossings) {
  std::vector<TapGroup> groups;
  for (std::size_t begin = 0; begin < crossings.size(); begin += groupSize) {
    const std::size_t end = std::min(begin + groupSize, crossings.size());
    groups.push_back(emptyGroup(begin, end, crossings[begin].enter, crossings[end - 1].leave));
    for (std::size_t k = begin; k < end; ++k) cover(groups.back().touched, crossings[k].cell);
  }
  return groups;
}

}  // namespace

AzimuthPlan planAzimuth(Vec2 direction, double radius, const PaddedMap& map) {
  AzimuthPlan plan{cutRay(direction, radius), {}, {}, {}};
  const std::vector<Crossing>& crossings = plan.ray.crossings;
  plan.taps.reserve(crossings.size());
  for (const Crossing& c : crossings) plan.taps.push_back(tapOf(c, direction, map));
  plan.groups = groupCrossings(crossings);
  plan.lastCell = emptyGroup(crossings.size(), crossings.size(), plan.ray.lastEnter, radius);
  cover(plan.lastCell.touched, plan.ray.lastCell);
  return plan;
}

double azimuthPlanBytes(double radius) {
  // A ray crosses at most √2 D lattice lines.
  return (sizeof(Crossing) + sizeof(Tap)) * (1.5 * radius + 2);
}

}  // namespace gnomon
