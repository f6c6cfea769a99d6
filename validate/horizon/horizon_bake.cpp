#include "horizon/horizon_bake.h"

#include <algorithm>
#include <cstddef>

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

}  // namespace gnomon::horizon
