#pragma once

#include <cstddef>

#include "relief/azimuth_plan.h"
#include "relief/box_maxima.h"
#include "relief/padded_map.h"

namespace gnomon {

/// A rectangle of texels of the map: columns [left, right), rows [bottom, top).
struct TexelTile {
  int left, bottom, right, top;
};

/// One azimuth of a map with all that bounds its rays.
struct AzimuthBake {
  const PaddedMap& map;
  const AzimuthPlan& plan;
  const BoxMaxima& groups;  ///< in boxes of the plan's sizes
  const BoxMaxima& bundles;
};

/// Finds the horizon and the distance of every texel of a tile for one azimuth, as horizon_bake.h
/// defines them, with the widest vectors of this processor; all give the same bits.
/// @param stride  entries from one row of the results to the next
/// @param horizon, distance  of the tile's first texel
void bakeTile(const AzimuthBake& bake, const TexelTile& tile, std::ptrdiff_t stride, float* horizon,
              float* distance);

/// The instruction set that `bakeTile` uses here, as Google Highway names it: "AVX3" is AVX-512.
const char* bakeInstructionSet();

}  // namespace gnomon
