#include "relief/horizon_bake.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <mutex>
#include <vector>

#include "common/error.h"
#include "common/memory.h"
#include "common/parallel.h"
#include "relief/azimuth_plan.h"
#include "relief/horizon_chunk.h"
#include "relief/padded_map.h"
#include "relief/ray_crossings.h"

namespace gnomon {
namespace {

constexpr int tileRows = 32;  ///< rows of a chunk that a thread takes at once

void checkSettings(const BakeSettings& settings) {
  if (settings.azimuths < 1) {
    throw InputError(
        fmt::format("bake.azimuths: {} found, at least 1 expected", settings.azimuths));
  }
  if (!(settings.radiusTexels > 0) || !std::isfinite(settings.radiusTexels)) {
    throw InputError(fmt::format("bake.radius: {} texels found, a finite number over 0 expected",
                                 settings.radiusTexels));
  }
}

void checkHeights(const HeightField& field) {
  // Differences of differences of heights are taken in floats.
  const double range = static_cast<double>(field.maximum()) - field.minimum();
  if (range > 1e37) {
    throw InputError(fmt::format("height map: heights from {} to {}, at most 1e+37 apart expected",
                                 field.minimum(), field.maximum()));
  }
}

void checkMemory(const HeightField& field, const BakeSettings& settings) {
  const double texels = static_cast<double>(field.width()) * field.height();
  const double bytes = 2 * sizeof(float) * texels * settings.azimuths +
                       paddedMapBytes(field, settings.radiusTexels, chunkWidth) +
                       azimuthPlanBytes(settings.radiusTexels) * settings.azimuths;
  requireMemory(
      bytes, fmt::format("bake.azimuths = {} and bake.radius = {} on a map of {} x {} "
                         "texels",
                         settings.azimuths, settings.radiusTexels, field.width(), field.height()));
}

HorizonTables emptyTables(const HeightField& field, const BakeSettings& settings) {
  HorizonTables tables;
  tables.width = field.width();
  tables.height = field.height();
  tables.azimuths = settings.azimuths;
  tables.radiusTexels = settings.radiusTexels;
  tables.wrap = field.wrap();
  const std::size_t entries = static_cast<std::size_t>(field.width()) *
                              static_cast<std::size_t>(field.height()) *
                              static_cast<std::size_t>(settings.azimuths);
  tables.horizon.resize(entries);
  tables.distance.resize(entries);
  return tables;
}

/// A column of chunks, `tileRows` high, of one azimuth: what a thread takes at once. Rays of
/// neighbouring rows read the same texels, so that these stay in its cache.
struct Tile {
  std::size_t azimuth;
  int column, row;
};

class Tiling {
 public:
  Tiling(const HeightField& field, int azimuths)
      : across_((field.width() + chunkWidth - 1) / chunkWidth),
        up_((field.height() + tileRows - 1) / tileRows),
        azimuths_(static_cast<std::size_t>(azimuths)) {}

  [[nodiscard]] std::size_t count() const { return azimuths_ * perAzimuth(); }
  [[nodiscard]] Tile tile(std::size_t index) const {
    const auto within = static_cast<int>(index % perAzimuth());
    return {index / perAzimuth(), within % across_ * chunkWidth, within / across_ * tileRows};
  }

 private:
  [[nodiscard]] std::size_t perAzimuth() const {
    return static_cast<std::size_t>(across_) * static_cast<std::size_t>(up_);
  }
  int across_, up_;
  std::size_t azimuths_;
};

void bakeTile(const PaddedMap& map, const AzimuthPlan& plan, const Tile& tile, ChunkBaker bakeChunk,
              HorizonTables& tables) {
  const auto width = static_cast<std::size_t>(tables.width);
  const auto count =
      std::min<std::size_t>(chunkWidth, width - static_cast<std::size_t>(tile.column));
  for (int y = tile.row; y < std::min(tile.row + tileRows, tables.height); ++y) {
    HorizonChunk chunk = chunkAt(map, map.margin + tile.column, map.margin + y);
    bakeChunk(map, plan, chunk);
    const std::size_t first =
        (tile.azimuth * static_cast<std::size_t>(tables.height) + static_cast<std::size_t>(y)) *
            width +
        static_cast<std::size_t>(tile.column);
    std::copy_n(chunk.slope.begin(), count,
                tables.horizon.begin() + static_cast<std::ptrdiff_t>(first));
    std::copy_n(chunk.distance.begin(), count,
                tables.distance.begin() + static_cast<std::ptrdiff_t>(first));
  }
}

/// Counts what is done and reports it, one call at a time.
class Counter {
 public:
  Counter(const Progress& progress, std::size_t total) : progress_(progress), total_(total) {}
  void add() {
    if (!progress_) return;
    const std::lock_guard lock(mutex_);
    progress_(static_cast<double>(++done_) / static_cast<double>(total_));
  }

 private:
  const Progress& progress_;
  std::size_t total_;
  std::size_t done_ = 0;
  std::mutex mutex_;
};

}  // namespace

HorizonTables bakeHorizons(const HeightField& field, const BakeSettings& settings,
                           const Progress& progress) {
  checkSettings(settings);
  checkHeights(field);
  checkMemory(field, settings);
  const PaddedMap map = padMap(field, settings.radiusTexels, chunkWidth);
  std::vector<AzimuthPlan> plans(static_cast<std::size_t>(settings.azimuths));
  parallelFor(0, plans.size(), [&](std::size_t m) {
    plans[m] = planAzimuth(azimuthDirection(static_cast<int>(m), settings.azimuths),
                           settings.radiusTexels, map);
  });
  HorizonTables tables = emptyTables(field, settings);
  const Tiling tiling(field, settings.azimuths);
  const ChunkBaker bakeChunk = chunkBaker();
  Counter counter(progress, tiling.count());
  parallelFor(0, tiling.count(), [&](std::size_t index) {
    const Tile tile = tiling.tile(index);
    bakeTile(map, plans[tile.azimuth], tile, bakeChunk, tables);
    counter.add();
  });
  return tables;
}

}  // namespace gnomon
