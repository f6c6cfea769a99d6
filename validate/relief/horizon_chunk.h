#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "relief/azimuth_plan.h"
#include "relief/padded_map.h"

namespace gnomon {

/// Texels of a row that are baked together.
constexpr int chunkWidth = 64;

/// The horizons of neighbouring texels in one row while a ray from each is followed outwards.
struct HorizonChunk {
  std::ptrdiff_t column, row;  ///< of the first texel in the padded map
  const float* heights;        ///< of the first texel
  const float* twists;
  alignas(64) std::array<float, chunkWidth> slope;     ///< greatest so far, height units per texel
  alignas(64) std::array<float, chunkWidth> distance;  ///< where it was found, texels; 0: at once
  /// What the slope of a farther point must exceed to count as greater.
  alignas(64) std::array<float, chunkWidth> threshold;
  /// Taps of the last group in whose cell the slope may have a peak: bit k for the k-th.
  alignas(64) std::array<std::int32_t, chunkWidth> peaks;
};

/// A chunk at this place of the padded map, its horizons not yet known.
HorizonChunk chunkAt(const PaddedMap& map, std::ptrdiff_t column, std::ptrdiff_t row);

/// Finds `slope` and `distance` of every texel of a chunk for one azimuth.
using ChunkBaker = void (*)(const PaddedMap&, const AzimuthPlan&, HorizonChunk&);

/// The baker for the widest vectors of this processor. All give the same results.
ChunkBaker chunkBaker();

}  // namespace gnomon
