#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "common/progress.h"
#include "common/raw_vector.h"
#include "horizon/horizon_bake.h"
#include "horizon/kernel/padded_map.h"
#include "horizon/reference.h"
#include "relief/height_field.h"

namespace gnomon::horizon {

/// A crossing for the inner loop of the bake: floats, and offsets into the padded map from the
/// texel where the ray starts. The slope at it is (h(from) + share · (h(to) - h(from)) - h0) / r.
struct Tap {
  std::ptrdiff_t from, to;
  float share;
  float distance;         ///< r, texels
  float inverseDistance;  ///< 1 / r
  float tolerance;        ///< slopes here equal a greater slope up to this difference
};

/// The cell that a ray leaves at a crossing, or in which it ends, with the data to find a peak of
/// the slope inside it. Along the ray the height in it is A + B r + C r² with C = -bend · twist.
struct CellPath {
  std::ptrdiff_t cell;  ///< offset of its lower left node
  float enter, length;  ///< r where the ray enters it, and how far it goes in it, texels
  float inverseEnter;   ///< 1 / r, 0 in the first cell
  float u, v;           ///< where it enters, 0 to 1 from the lower left node
  float bend;           ///< -e_x e_y
  /// Times the twist, an upper bound on how far the slope inside exceeds the slopes at both ends:
  /// bend · length² / (4 enter); 0 in the first cell, where the slope has no peak.
  float quarterBulge;
};

/// A stretch of a ray that is skipped or searched as a whole, and the box of nodes that bounds it.
struct Stretch {
  Node corner;         ///< lower left node of the box, folded
  float enter, leave;  ///< r at both ends, texels
  /// Upper bound on how far a peak inside a cell exceeds the slope where the ray leaves the cell.
  float peakRoom;
  float tolerance;  ///< the greatest of its taps
};

/// The ray of one azimuth, the same from every texel. Taps form groups, groups form bundles.
struct AzimuthPlan {
  static constexpr std::size_t groupTaps = 8;
  static constexpr std::size_t bundleGroups = 8;

  Vec2 direction;
  double radius = 0;
  std::vector<Tap> taps;        ///< the last one repeated to fill its group
  std::vector<CellPath> cells;  ///< before each tap
  std::vector<Stretch> groups;
  std::vector<Stretch> bundles;
  BoxSize groupBox, bundleBox;  ///< the boxes that bound every group and every bundle
  bool endsInCell = false;      ///< false if the ray ends on a lattice line
  CellPath lastCell;            ///< in which it ends
  Stretch end;                  ///< the same as a stretch, in a box as a group's
};

/// @param direction  unit; @param radius  D > 0, texels
AzimuthPlan planAzimuth(Vec2 direction, double radius, const PaddedMap& map);

/// Upper bound on the memory of one plan, bytes.
double azimuthPlanBytes(double radius);

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

/// Scratch memory of one thread for baking tiles. It is kept from one tile to the next, since fresh
/// memory costs more than what is written to it. How many texels are in a vector depends on the
/// processor: [vector][lane] stands for consecutive floats.
struct TileScratch {
  /// Of each texel, [vector][lane]: its height, the limit r → 0⁺ of the slope, the greatest slope
  /// so far, the least distance of it, and the slope where the ray ends.
  alignas(64) std::array<float, TexelTile::texels> height, start, best, distance, end;
  /// Of each vector: where its first texel lies in the padded map.
  std::array<std::int32_t, TexelTile::texels> row, column;
  std::array<std::ptrdiff_t, TexelTile::texels> offset;

  std::vector<Visit> winners;  ///< groups that attained a horizon somewhere in the tile

  // Lists of a batch. Each keeps its largest capacity; the counts say how many entries are valid.
  std::array<std::uint32_t, TexelTile::texels> batch, active, open;  ///< vectors
  std::vector<std::uint8_t>
      foreseen;  ///< [vector][bundle]: one bit a group, set where it was searched first, as a guess
  RawVector<Visit> visits;        ///< groups to be searched next
  RawVector<Visit> kept;          ///< groups that were searched and may hold a horizon
  RawVector<float> slopes;        ///< [kept][tap of the group][lane]
  RawVector<float> highest;       ///< [kept][lane]: of the group's slopes
  RawVector<std::uint32_t> high;  ///< indices of `kept`
  RawVector<CellVisit> cells;     ///< cells that may hold a peak
  RawVector<std::uint32_t> peakVectors;
  RawVector<float> peaks;  ///< [peak][0: slope, 1: r][lane]
  std::size_t batchCount = 0, keptCount = 0, peakCount = 0;
};

/// Upper bound on the memory of one TileScratch, bytes: every tap of every texel of a batch, each
/// with a peak.
/// @param radius  D, texels
double tileScratchBytes(double radius);

/// The horizons of a tile of texels for one azimuth: the unit of work of a thread.
struct HorizonTile {
  int azimuth = 0;
  TexelTile tile;
  /// [y - bottom][x - left], rows TexelTile::width apart.
  std::array<float, TexelTile::texels> horizon, distance;
};

/// Calls `take(entry, from, count)` for each row of a tile: `count` values from index `from` of the
/// tile on belong at `entry` and after it in the table.
template <typename Take>
void forEachRow(const HorizonTile& baked, const TableShape& table, const Take& take) {
  const TexelTile& tile = baked.tile;
  for (int y = tile.bottom; y < tile.top; ++y) {
    take(table.entry(baked.azimuth, tile.left, y),
         static_cast<std::size_t>(y - tile.bottom) * TexelTile::width,
         static_cast<std::size_t>(tile.right - tile.left));
  }
}

/// Receives each tile of each azimuth once, on the thread that baked it.
using TileSink = std::function<void(const HorizonTile&)>;

/// Refuses a bake that is out of range or cannot fit, before anything is allocated.
/// @param tableBytes  what the sink will hold
/// @throws InputError, MemoryError as `bakeHorizons`
void checkBake(const relief::HeightField& field, const BakeSettings& settings, double tableBytes);

/// Bakes a map tile by tile: apart from what the sink holds, the memory grows with the map and the
/// radius alone, not with the azimuths.
void bakeTiles(const relief::HeightField& field, const BakeSettings& settings, const TileSink& sink,
               const Progress& progress = {});

}  // namespace gnomon::horizon
