#include "study/table_set.h"

#include "relief/angle_table.h"
#include "relief/horizon_ellipses.h"
#include "truth/surface_horizons.h"

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

const GpuAngles& TableSet::angles(const BakeSpec& spec, StageClock& clock) {
  const std::tuple key(spec.settings.azimuths, spec.settings.radiusTexels, spec.angleLimit,
                       spec.bits);
  const auto found = angles_.find(key);
  if (found != angles_.end()) return found->second;
  const HorizonTables& baked = bake(spec.settings, clock);
  return clock.measure("tables", [&](const Progress&) -> const GpuAngles& {
    return angles_.try_emplace(key, horizonAngles(baked, spec.angleLimit), spec.bits).first->second;
  });
}

const GpuAngles& TableSet::surfaceAngles(const BakeSpec& spec, const HorizonScene& scene,
                                         StageClock& clock) {
  const std::tuple key(spec.settings.azimuths, spec.angleLimit, spec.bits);
  const auto found = surfaceAngles_.find(key);
  if (found != surfaceAngles_.end()) return found->second;
  AngleTable table = clock.measure("surface horizons", [&](const Progress& progress) {
    return shootHorizons(scene.surface, scene.relief, scene.mesh, scene.scene, scene.texels,
                         spec.settings.azimuths, spec.angleLimit, progress);
  });
  table.originX = scene.origin.x;
  table.originY = scene.origin.y;
  return surfaceAngles_.try_emplace(key, table, spec.bits).first->second;
}

const GpuTable& TableSet::ellipses(const BakeSpec& spec, StageClock& clock) {
  const Key key(spec.settings.azimuths, spec.settings.radiusTexels, spec.bits);
  const auto found = ellipses_.find(key);
  if (found != ellipses_.end()) return found->second;
  const HorizonTables& baked = bake(spec.settings, clock);
  return clock.measure("tables", [&](const Progress&) -> const GpuTable& {
    const EllipseTable fitted = fitEllipses(baked);
    return ellipses_
        .try_emplace(key, storeTable(fitted.values, spec.bits), fitted.width, fitted.height,
                     EllipseTable::layers, fitted.wrap)
        .first->second;
  });
}

}  // namespace gnomon
