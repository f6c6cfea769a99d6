#include "horizon/kernel/tile_scratch.h"

#include "horizon/kernel/azimuth_plan.h"

namespace gnomon::horizon {

double tileScratchBytes(double radius) {
  // A ray crosses at most √2 D lattice lines. Of each, a texel may keep the slope, a peak and its
  // r; the lists' entries stand for vectors, at worst of one texel.
  const double taps = 1.5 * radius + 2 + AzimuthPlan::groupTaps;
  const double batch = TexelTile::texels / 2.0;
  return sizeof(TileScratch) +
         batch * taps * (3 * sizeof(float) + sizeof(CellVisit) + sizeof(std::uint32_t)) +
         batch * taps / AzimuthPlan::groupTaps *
             (2 * sizeof(Visit) + sizeof(float) + sizeof(std::uint32_t));
}

}  // namespace gnomon::horizon
