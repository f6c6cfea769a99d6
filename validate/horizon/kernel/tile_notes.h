#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/raw_vector.h"

namespace gnomon {

/// A rectangle of texels of the map: columns [left, right), rows [bottom, top).
struct TexelTile {
  static constexpr int width = 64, height = 32;  ///< of all but those at the map's edges
  static constexpr std::size_t texels = std::size_t{width} * height;
  int left, bottom, right, top;
};

/// A group of taps (AzimuthPlan) on the rays of one vector of a tile's texels.
struct Visit {
  std::uint32_t vector, group;
};

/// A cell before a tap on the rays of one vector.
struct CellVisit {
  std::uint32_t vector, tap;
};

/// What baking a tile writes down on the way. It is kept from one tile to the next, since fresh
/// memory costs more than what is written to it. How many texels are in a vector depends on the
/// processor: [vector][lane] stands for consecutive floats.
struct TileNotes {
  /// Of each texel, [vector][lane]: its height, the limit r → 0⁺ of the slope, the greatest slope
  /// so far, the least distance of it, and the slope where the ray ends.
  alignas(64) std::array<float, TexelTile::texels> height, start, best, distance, end;
  /// Of each vector: where its first texel lies in the padded map.
  std::array<std::int32_t, TexelTile::texels> row, column;
  std::array<std::ptrdiff_t, TexelTile::texels> offset;

  std::vector<Visit> winners;  ///< that attained a horizon somewhere in the tile

  // Lists of a turn. Vectors are as long as any turn needed; what is in them the counts say.
  std::array<std::uint32_t, TexelTile::texels> turn, active, open;  ///< vectors
  std::vector<std::uint8_t> foreseen;  ///< [vector][bundle]: a bit for each group taken as a guess
  RawVector<Visit> visits;             ///< to be taken next
  RawVector<Visit> kept;               ///< taken, and high enough to matter perhaps
  RawVector<float> slopes;             ///< [kept][tap of the group][lane]
  RawVector<float> highest;            ///< [kept][lane]: of the group's slopes
  RawVector<std::uint32_t> high;       ///< indices of `kept`
  RawVector<CellVisit> cells;          ///< that may hold a peak
  RawVector<std::uint32_t> peakVectors;
  RawVector<float> peaks;  ///< [peak][0: slope, 1: r][lane]
  std::size_t turnCount = 0, keptCount = 0, peakCount = 0;
};

/// A bound on the memory of a tile's notes, bytes: every tap of every texel of a turn, each with a
/// peak.
/// @param radius  D, texels
double tileNotesBytes(double radius);

}  // namespace gnomon
