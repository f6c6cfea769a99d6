#include "horizon/horizon_bake.h"

#include <algorithm>
#include <cstddef>

#include "horizon/kernel/horizon_tiles.h"

namespace gnomon {
namespace {

HorizonTables emptyTables(const HeightField& field, const BakeSettings& settings) {
  HorizonTables tables;
  tables.width = field.width();
  tables.height = field.height();
  tables.azimuths = settings.azimuths;
  tables.radiusTexels = settings.radiusTexels;
  tables.wrap = field.wrap();
  tables.border = field.border();
  const std::size_t entries = static_cast<std::size_t>(field.width()) *
                              static_cast<std::size_t>(field.height()) *
                              static_cast<std::size_t>(settings.azimuths);
  tables.horizon.resize(entries);
  tables.distance.resize(entries);
  return tables;
}

}  // namespace

HorizonTables bakeHorizons(const HeightField& field, const BakeSettings& settings,
                           const Progress& progress) {
  const double texels = static_cast<double>(field.width()) * field.height();
  checkBake(field, settings, 2 * sizeof(float) * texels * settings.azimuths);
  HorizonTables tables = emptyTables(field, settings);
  const auto keep = [&](const HorizonTile& baked) {
    forEachRow(baked, tables.width, tables.height,
               [&](std::size_t entry, std::size_t from, std::size_t count) {
                 std::copy_n(baked.horizon.data() + from, count, tables.horizon.data() + entry);
                 std::copy_n(baked.distance.data() + from, count, tables.distance.data() + entry);
               });
  };
  bakeTiles(field, settings, keep, progress);
  return tables;
}

}  // namespace gnomon
