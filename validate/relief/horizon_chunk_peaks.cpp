#include "relief/horizon_chunk_peaks.h"

#include <cmath>
#include <cstdint>

namespace gnomon {
namespace {

/// Takes a slope at r if it is the greatest. Peaks are looked at after their whole group, so a
/// nearer one that equals the best must win.
void offer(HorizonChunk& chunk, std::size_t texel, double slope, double r, double tolerance) {
  const auto distance = static_cast<float>(r);
  const bool greater = slope > chunk.threshold[texel];
  const bool equalAndNearer =
      distance < chunk.distance[texel] && slope + tolerance / r >= chunk.slope[texel];
  if (!greater && !equalAndNearer) return;
  chunk.slope[texel] = static_cast<float>(slope);
  chunk.distance[texel] = distance;
  chunk.threshold[texel] = static_cast<float>(slope + tolerance / r);
}

/// The profile g(ρ) = rise + slope ρ + bend ρ² of h - h0 along a ray in one cell, ρ from the point
/// where it enters.
struct Profile {
  double rise, slope, bend;

  [[nodiscard]] double at(double rho) const { return rise + rho * (slope + rho * bend); }
};

Profile profileInCell(const HorizonChunk& chunk, std::size_t texel, std::ptrdiff_t stride, Vec2 e,
                      Node cell, double enter) {
  const float* corner = chunk.heights + texel + cell.y * stride + cell.x;
  const double h0 = chunk.heights[texel];
  const double h00 = corner[0];
  const double alongX = corner[1] - h00;
  const double alongY = corner[stride] - h00;
  const double twist = corner[stride + 1] - h00 - alongX - alongY;
  const double u = enter * e.x - cell.x;
  const double v = enter * e.y - cell.y;
  return {(h00 - h0) + alongX * u + alongY * v + twist * u * v,
          alongX * e.x + alongY * e.y + twist * (u * e.y + v * e.x), twist * e.x * e.y};
}

/// The maximum of g(ρ) / (enter + ρ) inside a cell, where there is one: its derivative vanishes at
/// bend ρ² + 2 bend enter ρ + slope enter - rise = 0.
void offerPeak(HorizonChunk& chunk, std::size_t texel, const Profile& g, double enter, double leave,
               double tolerance) {
  const double climb = g.slope * enter - g.rise;
  if (!(g.bend < 0) || !(climb > 0)) return;
  const double x = -climb / g.bend;
  const double rho = x / (enter + std::sqrt(enter * enter + x));
  if (!(rho < leave - enter)) return;
  const double r = enter + rho;
  offer(chunk, texel, g.at(rho) / r, r, tolerance);
}

}  // namespace

void takeMarkedPeaks(const PaddedMap& map, const AzimuthPlan& plan, const TapGroup& group,
                     std::size_t begin, std::size_t end, HorizonChunk& chunk) {
  for (std::size_t texel = begin; texel < end; ++texel) {
    for (auto bits = static_cast<std::uint32_t>(chunk.peaks[texel]); bits != 0; bits &= bits - 1) {
      const auto bit = static_cast<std::size_t>(__builtin_ctz(bits));
      const Crossing& c = plan.ray.crossings[group.begin + bit];
      const Profile g =
          profileInCell(chunk, texel, map.stride, plan.ray.direction, c.cell, c.enter);
      offerPeak(chunk, texel, g, c.enter, c.leave, map.tolerance);
    }
  }
}

void takeLastCell(const PaddedMap& map, const AzimuthPlan& plan, std::size_t begin, std::size_t end,
                  HorizonChunk& chunk) {
  const RayCrossings& ray = plan.ray;
  for (std::size_t texel = begin; texel < end; ++texel) {
    const Profile g =
        profileInCell(chunk, texel, map.stride, ray.direction, ray.lastCell, ray.lastEnter);
    if (ray.lastEnter > 0) {
      offerPeak(chunk, texel, g, ray.lastEnter, ray.radius, map.tolerance);
    }
    const double slope = g.at(ray.radius - ray.lastEnter) / ray.radius;
    offer(chunk, texel, slope, ray.radius, map.tolerance);
  }
}

}  // namespace gnomon
