#include "study/run/scene/table_set.h"

#include <memory>
#include <span>

#include "horizon/angle_table.h"
#include "horizon/horizon_ellipses.h"
#include "study/run/scene/cached_fields.h"
#include "study/spec/with_keys.h"

namespace gnomon::study {
namespace {

double horizonBytes(const relief::HeightField& field, const horizon::BakeSettings& settings) {
  return 2 * sizeof(float) * static_cast<double>(field.texels().size()) *
         static_cast<double>(settings.azimuths);
}

}  // namespace

bool keepsHorizons(const relief::HeightField& field, const horizon::BakeSettings& settings) {
  // Beyond this, writing them takes longer than baking, and room from everything else.
  constexpr double mostBytes = 5e8;
  return horizonBytes(field, settings) <= mostBytes;
}

horizon::HorizonTables keptHorizons(cache::Cache& cache, const relief::HeightField& field,
                                    const BakeSpec& bake, const Progress& progress) {
  const auto make = [&] {
    return withKeys("bake", [&] { return horizon::bakeHorizons(field, bake.settings, progress); });
  };
  constexpr double fewBytes = 1.6e7;  // are baked as fast as they are written, in 0.05 s
  const bool isKept =
      keepsHorizons(field, bake.settings) && horizonBytes(field, bake.settings) > fewBytes;
  // The kernel gives the same bits on all instruction sets, see tests/horizon/horizon_targets_test
  // and tests/end_to_end/processors_test.
  return isKept ? cache.remember(bakeKey(field, bake), make, cache::HoldsOn::anyProcessor) : make();
}

const horizon::HorizonTables& TableSet::bake(const BakeSpec& spec, StageClock& clock) {
  std::shared_ptr<const horizon::HorizonTables>& held = bakes_[settingsKey(spec, Enters::horizons)];
  if (held) return *held;
  held = store_.get<horizon::HorizonTables>(
      bakeKey(field_, spec),
      [&] {
        return clock.measure("bake", [&](const Progress& progress) {
          return std::make_shared<const horizon::HorizonTables>(
              keptHorizons(cache_, field_, spec, progress));
        });
      },
      [](const horizon::HorizonTables& tables) {
        return sizeof(float) * (tables.horizon.size() + tables.distance.size());
      });
  return *held;
}

const TablePair& TableSet::tables(const BakeSpec& spec, StageClock& clock) {
  const cache::ContentKey settings = settingsKey(spec, Enters::horizons | Enters::codes);
  std::shared_ptr<const TablePair>& held = stored_[settings];
  if (held) return *held;
  const auto make = [&] {
    const horizon::HorizonTables& baked = bake(spec, clock);
    return clock.measure("tables", [&](const Progress&) {
      const auto store = [&](std::span<const float> values) {
        return render::GpuTable(horizon::storeTable(values, spec.bits), baked);
      };
      return std::make_shared<const TablePair>(
          TablePair{store(baked.horizon), store(baked.distance)});
    });
  };
  const cache::ContentKey key = cache::KeyBuilder("tables")
                                    .add("bake", bakeKey(field_, spec))
                                    .add("settings", settings)
                                    .key();
  held = store_.get<TablePair>(key, make, [](const TablePair& pair) {
    return pair.horizon.byteCount() + pair.distance.byteCount();
  });
  return *held;
}

const render::GpuAngles& TableSet::angles(const BakeSpec& spec, StageClock& clock) {
  const cache::ContentKey settings =
      settingsKey(spec, Enters::horizons | Enters::codes | Enters::flatAngles);
  std::shared_ptr<const render::GpuAngles>& held = angles_[settings];
  if (held) return *held;
  const cache::ContentKey key = cache::KeyBuilder("flat angles")
                                    .add("bake", bakeKey(field_, spec))
                                    .add("settings", settings)
                                    .add("scale", texelsPerHeight_)
                                    .key();
  const auto make = [&] {
    const horizon::HorizonTables& baked = bake(spec, clock);
    return clock.measure("tables", [&](const Progress&) {
      return std::make_shared<const render::GpuAngles>(
          horizon::horizonAngles(baked, spec.angleLimit, texelsPerHeight_), spec.bits);
    });
  };
  held = store_.get<render::GpuAngles>(
      key, make, [](const render::GpuAngles& angles) { return angles.byteCount(); });
  return *held;
}

const render::GpuAngles& TableSet::surfaceAngles(const BakeSpec& spec, const MeshChoice& mesh,
                                                 const HorizonShooter& shoot) {
  const cache::ContentKey settings = settingsKey(spec, Enters::shotAngles | Enters::codes);
  std::shared_ptr<const render::GpuAngles>& held = surfaceAngles_[{mesh, settings}];
  if (held) return *held;
  const cache::ContentKey shot = keys_.surfaceAngles(mesh, spec);
  const cache::ContentKey key =
      cache::KeyBuilder("surface angles").add("shot", shot).add("settings", settings).key();
  held = store_.get<render::GpuAngles>(
      key,
      [&] {
        return std::make_shared<const render::GpuAngles>(cache_.remember(shot, shoot), spec.bits);
      },
      [](const render::GpuAngles& angles) { return angles.byteCount(); });
  return *held;
}

const render::GpuTable& TableSet::ellipses(const BakeSpec& spec, StageClock& clock) {
  const cache::ContentKey key = settingsKey(spec, Enters::horizons | Enters::codes);
  const auto found = ellipses_.find(key);
  if (found != ellipses_.end()) return found->second;
  const horizon::HorizonTables& baked = bake(spec, clock);
  return clock.measure("tables", [&](const Progress&) -> const render::GpuTable& {
    const horizon::EllipseTable fitted =
        cache_.remember(keys_.ellipses(spec, texelsPerHeight_),
                        [&] { return horizon::fitEllipses(baked, texelsPerHeight_); });
    return ellipses_.try_emplace(key, horizon::storeTable(fitted.values, spec.bits), fitted)
        .first->second;
  });
}

}  // namespace gnomon::study
