#pragma once

#include <functional>
#include <map>
#include <memory>
#include <tuple>
#include <utility>

#include "cache/cache.h"
#include "horizon/horizon_bake.h"
#include "render/gpu_scene.h"
#include "study/run/scene/run_keys.h"
#include "study/run/scene/scene_store.h"
#include "study/run/scene/stage_clock.h"
#include "study/spec/study_file.h"
#include "surface/sample_grid.h"

namespace gnomon::study {

/// The horizon and distance table of one bake on the GPU, in the bits of one method.
struct TablePair {
  render::GpuTable horizon;
  render::GpuTable distance;
};

/// Shoots the displaced surface's own horizons.
using HorizonShooter = std::function<horizon::AngleTable()>;

/// The tables that a study's methods ask for: every bake is done once, if the cache does not have
/// it, and stored once for each number of bits. References stay valid while the set lives.
class TableSet {
 public:
  /// All must outlive it.
  /// @param texelsPerHeight  of the frame of angles (texel_scale.h)
  TableSet(const relief::HeightField& field, double texelsPerHeight, cache::Cache& cache,
           SceneStore& store, const RunKeys& keys)
      : field_(field),
        texelsPerHeight_(texelsPerHeight),
        cache_(cache),
        store_(store),
        keys_(keys) {}

  /// @param clock  of the stages "bake" and "tables"
  const TablePair& tables(const BakeSpec& spec, StageClock& clock);
  /// Horizon angles of the flat relief.
  const render::GpuAngles& angles(const BakeSpec& spec, StageClock& clock);
  /// Horizon angles of the displaced surface, at the texels that a mesh shows.
  /// @param shoot  asked where there are none yet
  const render::GpuAngles& surfaceAngles(const BakeSpec& spec, const MeshChoice& mesh,
                                         const HorizonShooter& shoot);
  /// Elliptical cones of light, fitted to the horizons of the bake.
  const render::GpuTable& ellipses(const BakeSpec& spec, StageClock& clock);

 private:
  const horizon::HorizonTables& bake(const BakeSpec& spec, StageClock& clock);

  const relief::HeightField& field_;
  double texelsPerHeight_;
  cache::Cache& cache_;
  SceneStore& store_;
  const RunKeys& keys_;
  // By the settings that enter each, see settingsKey.
  std::map<cache::ContentKey, std::shared_ptr<const horizon::HorizonTables>> bakes_;
  std::map<cache::ContentKey, std::shared_ptr<const TablePair>> stored_;
  std::map<cache::ContentKey, render::GpuTable> ellipses_;
  std::map<cache::ContentKey, std::shared_ptr<const render::GpuAngles>> angles_;
  std::map<std::pair<MeshChoice, cache::ContentKey>, std::shared_ptr<const render::GpuAngles>>
      surfaceAngles_;
};

/// Whether a bake is small enough to be held as a whole, and to be kept.
bool keepsHorizons(const relief::HeightField& field, const horizon::BakeSettings& settings);

/// bakeHorizons, or what the cache has of it. The cache has none that is baked in 0.05 s.
horizon::HorizonTables keptHorizons(cache::Cache& cache, const relief::HeightField& field,
                                    const BakeSpec& bake, const Progress& progress);

}  // namespace gnomon::study
