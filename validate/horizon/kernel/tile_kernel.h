#pragma once

#include <cstddef>

#include "horizon/kernel/horizon_tiles.h"
#include "horizon/kernel/padded_map.h"

namespace gnomon::horizon {

/// The map, the ray and the bounds for one azimuth.
struct AzimuthBake {
  const PaddedMap& map;
  const AzimuthPlan& plan;
  const BoxMaxima& groups;  ///< in boxes of the plan's sizes, every row
  const BoxMaxima& bundles;
};

/// Finds the horizon and the distance of every texel of a tile for one azimuth, as horizon_bake.h
/// defines them, with the widest vectors of this processor; all give the same bits.
///
/// A few rows make a batch, and each step of the search is done for all of them before
/// the next: lists say for which vectors of texels and which groups of taps. So the processor
/// neither waits for unpredictable branches nor fetches the same part of the map again.
/// @param tile    no larger than TexelTile::width × TexelTile::height
/// @param scratch  of any tile baked before
/// @param stride  entries from one row of the results to the next
/// @param horizon, distance  of the tile's first texel
void bakeTile(const AzimuthBake& bake, const TexelTile& tile, TileScratch& scratch,
              std::ptrdiff_t stride, float* horizon, float* distance);

/// The instruction set that `bakeTile` uses here, as Google Highway names it: "AVX3" is AVX-512.
const char* bakeInstructionSet();

}  // namespace gnomon::horizon
