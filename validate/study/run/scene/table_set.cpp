#include "study/run/scene/table_set.h"

#include <span>

#include "horizon/angle_table.h"
#include "horizon/horizon_ellipses.h"
#include "study/run/scene/cached_fields.h"
#include "study/spec/with_keys.h"

namespace gnomon {

bool keepsHorizons(const HeightField& field, const BakeSettings& settings) {
  // Beyond this, writing them takes longer than baking, and room from everything else.
  constexpr double mostBytes = 5e8;
  return 2 * sizeof(float) * static_cast<double>(field.texels().size()) *
             static_cast<double>(settings.azimuths) <=
         mostBytes;
}

HorizonTables keptHorizons(Cache& cache, const HeightField& field, const BakeSpec& bake,
                           const Progress& progress) {
  const auto make = [&] {
    return withKeys("bake", [&] { return bakeHorizons(field, bake.settings, progress); });
  };
  // The kernel gives the same bits on all instruction sets, see tests/horizon/horizon_targets_test
  // and tests/end_to_end/processors_test.
  return keepsHorizons(field, bake.settings)
             ? cache.remember(bakeKey(field, bake), make, HoldsOn::anyProcessor)
             : make();
}

const HorizonTables& TableSet::bake(const BakeSpec& spec, StageClock& clock) {
  const ContentKey key = settingsKey(spec, Enters::horizons);
  const auto found = bakes_.find(key);
  if (found != bakes_.end()) return found->second;
  return bakes_
      .emplace(key, clock.measure("bake",
                                  [&](const Progress& progress) {
                                    return keptHorizons(cache_, field_, spec, progress);
                                  }))
      .first->second;
}

const TablePair& TableSet::tables(const BakeSpec& spec, StageClock& clock) {
  const ContentKey key = settingsKey(spec, Enters::horizons | Enters::codes);
  const auto found = stored_.find(key);
  if (found != stored_.end()) return found->second;
  const HorizonTables& baked = bake(spec, clock);
  return clock.measure("tables", [&](const Progress&) -> const TablePair& {
    const auto store = [&](std::span<const float> values) {
      return GpuTable(storeTable(values, spec.bits), baked);
    };
    return stored_.emplace(key, TablePair{store(baked.horizon), store(baked.distance)})
        .first->second;
  });
}

const GpuAngles& TableSet::angles(const BakeSpec& spec, StageClock& clock) {
  const ContentKey key = settingsKey(spec, Enters::horizons | Enters::codes | Enters::flatAngles);
  const auto found = angles_.find(key);
  if (found != angles_.end()) return found->second;
  const HorizonTables& baked = bake(spec, clock);
  return clock.measure("tables", [&](const Progress&) -> const GpuAngles& {
    return angles_
        .try_emplace(key, horizonAngles(baked, spec.angleLimit, texelsPerHeight_), spec.bits)
        .first->second;
  });
}

const GpuAngles& TableSet::surfaceAngles(const BakeSpec& spec, const MeshChoice& mesh,
                                         const HorizonShooter& shoot) {
  const std::pair key(mesh, settingsKey(spec, Enters::shotAngles | Enters::codes));
  const auto found = surfaceAngles_.find(key);
  if (found != surfaceAngles_.end()) return found->second;
  const AngleTable table = cache_.remember(keys_.surfaceAngles(mesh, spec), shoot);
  return surfaceAngles_.try_emplace(key, table, spec.bits).first->second;
}

const GpuTable& TableSet::ellipses(const BakeSpec& spec, StageClock& clock) {
  const ContentKey key = settingsKey(spec, Enters::horizons | Enters::codes);
  const auto found = ellipses_.find(key);
  if (found != ellipses_.end()) return found->second;
  const HorizonTables& baked = bake(spec, clock);
  return clock.measure("tables", [&](const Progress&) -> const GpuTable& {
    const EllipseTable fitted = cache_.remember(keys_.ellipses(spec, texelsPerHeight_), [&] {
      return fitEllipses(baked, texelsPerHeight_);
    });
    return ellipses_.try_emplace(key, storeTable(fitted.values, spec.bits), fitted).first->second;
  });
}

}  // namespace gnomon
