#include "study/table_set.h"

namespace gnomon {

const HorizonTables& TableSet::bake(const BakeSettings& settings, StageClock& clock) {
  const std::pair key(settings.azimuths, settings.radiusTexels);
  const auto found = bakes_.find(key);
  if (found != bakes_.end()) return found->second;
  return bakes_
      .emplace(key, clock.measure("bake",
                                  [&](const Progress& progress) {
                                    return bakeHorizons(field_, settings, progress);
                                  }))
      .first->second;
}

const TablePair& TableSet::tables(const BakeSpec& spec, StageClock& clock) {
  const std::tuple key(spec.settings.azimuths, spec.settings.radiusTexels, spec.bits);
  const auto found = stored_.find(key);
  if (found != stored_.end()) return found->second;
  const HorizonTables& baked = bake(spec.settings, clock);
  return clock.measure("tables", [&](const Progress&) -> const TablePair& {
    const auto store = [&](const std::vector<float>& values) {
      return GpuTable(storeTable(values, spec.bits), baked.width, baked.height, baked.azimuths,
                      baked.wrap);
    };
    return stored_.emplace(key, TablePair{store(baked.horizon), store(baked.distance)})
        .first->second;
  });
}

}  // namespace gnomon
