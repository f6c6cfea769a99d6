#include "horizon/horizon_bake.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <mutex>

#include "horizon/kernel/horizon_tiles.h"

namespace gnomon::horizon {

HorizonTables bakeHorizons(const relief::HeightField& field, const BakeSettings& settings,
                           const Progress& progress) {
  const double texels = static_cast<double>(field.width()) * field.height();
  checkBake(field, settings, 2 * sizeof(float) * texels * settings.azimuths);
  HorizonTables tables{TableShape::over(field, settings.azimuths), settings.radiusTexels, {}, {}};
  tables.horizon.resize(tables.entries());
  tables.distance.resize(tables.entries());
  const auto keep = [&](const HorizonTile& baked) {
    forEachRow(baked, tables, [&](std::size_t entry, std::size_t from, std::size_t count) {
      std::copy_n(baked.horizon.data() + from, count, tables.horizon.data() + entry);
      std::copy_n(baked.distance.data() + from, count, tables.distance.data() + entry);
    });
  };
  bakeTiles(field, settings, keep, progress);
  return tables;
}

namespace {

/// The extremes of what it is shown, on any thread.
struct Extremes {
  float low = std::numeric_limits<float>::infinity();
  float high = -std::numeric_limits<float>::infinity();

  void include(const float* values, std::size_t count) {
    const auto [least, most] = std::minmax_element(values, values + count);
    include({*least, *most});
  }
  void include(const Extremes& other) {
    low = std::min(low, other.low);
    high = std::max(high, other.high);
  }
};

struct TableExtremes {
  Extremes horizon, distance;
};

TableExtremes findExtremes(const relief::HeightField& field, const BakeSettings& settings,
                           const Progress& progress) {
  TableExtremes all;
  std::mutex mutex;
  const auto include = [&](const HorizonTile& baked) {
    TableExtremes tile;
    forEachRow(baked, TableShape::over(field, settings.azimuths),
               [&](std::size_t, std::size_t from, std::size_t count) {
                 tile.horizon.include(baked.horizon.data() + from, count);
                 tile.distance.include(baked.distance.data() + from, count);
               });
    const std::lock_guard lock(mutex);
    all.horizon.include(tile.horizon);
    all.distance.include(tile.distance);
  };
  bakeTiles(field, settings, include, progress);
  return all;
}

/// Floats are stored as they are, so that their extremes can be found afterwards.
void includeAll(StoredTable& table) {
  for (std::size_t i = 0; i < table.entryCount(); ++i) {
    const float value = table.value(i);
    table.low = std::min(table.low, value);
    table.high = std::max(table.high, value);
  }
}

/// The part [begin, end) of the whole progress.
Progress partOf(const Progress& progress, double begin, double end) {
  if (!progress) return {};
  return [&progress, begin, end](double share) { progress(begin + share * (end - begin)); };
}

}  // namespace

StoredHorizons bakeStoredHorizons(const relief::HeightField& field, const BakeSettings& settings,
                                  TableBits bits, const Progress& progress) {
  const double entries = static_cast<double>(field.width()) * field.height() * settings.azimuths;
  checkBake(field, settings, 2 * entries * static_cast<int>(bits) / 8);
  const bool coded = bits != TableBits::thirtyTwo;
  const TableExtremes extremes =
      coded ? findExtremes(field, settings, partOf(progress, 0, 0.5)) : TableExtremes{};
  StoredHorizons stored{TableShape::over(field, settings.azimuths), settings.radiusTexels, {}, {}};
  const std::size_t count = stored.entries();
  stored.horizon = emptyTable(count, bits, extremes.horizon.low, extremes.horizon.high);
  stored.distance = emptyTable(count, bits, extremes.distance.low, extremes.distance.high);
  const auto keep = [&](const HorizonTile& baked) {
    forEachRow(baked, stored, [&](std::size_t entry, std::size_t from, std::size_t row) {
      stored.horizon.set(entry, {baked.horizon.data() + from, row});
      stored.distance.set(entry, {baked.distance.data() + from, row});
    });
  };
  bakeTiles(field, settings, keep, partOf(progress, coded ? 0.5 : 0, 1));
  if (!coded) {
    includeAll(stored.horizon);
    includeAll(stored.distance);
  }
  return stored;
}

}  // namespace gnomon::horizon
