#pragma once

#include <array>
#include <cstddef>
#include <functional>

#include "common/progress.h"
#include "horizon/horizon_bake.h"
#include "horizon/kernel/tile_scratch.h"
#include "relief/height_field.h"

namespace gnomon::horizon {

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

/// Bakes a map tile by tile: beside what the sink holds, the memory grows with the map and the
/// radius alone, not with the azimuths.
void bakeTiles(const relief::HeightField& field, const BakeSettings& settings, const TileSink& sink,
               const Progress& progress = {});

}  // namespace gnomon::horizon
