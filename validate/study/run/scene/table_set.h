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

namespace gnomon {

/// The horizon and distance table of one bake on the GPU, in the bits of one method.
struct TablePair {
  GpuTable horizon;
  GpuTable distance;
};

/// Shoots the displaced surface's own horizons.
using HorizonShooter = std::function<AngleTable()>;

/// The tables that a study's methods ask for: every bake is done once, if the cache does not have
/// it, and stored once for each number of bits. References stay valid while the set lives.
class TableSet {
 public:
  /// All must outlive it.
  /// @param texelsPerHeight  of the frame of angles (texel_scale.h)
  TableSet(const HeightField& field, double texelsPerHeight, Cache& cache, SceneStore& store,
           const RunKeys& keys)
      : field_(field),
        texelsPerHeight_(texelsPerHeight),
        cache_(cache),
        store_(store),
        keys_(keys) {}

  /// @param clock  of the stages "bake" and "tables"
  const TablePair& tables(const BakeSpec& spec, StageClock& clock);
  /// Horizon angles of the flat relief.
  const GpuAngles& angles(const BakeSpec& spec, StageClock& clock);
  /// Horizon angles of the displaced surface, at the texels that a mesh shows.
  /// @param shoot  asked where there are none yet
  const GpuAngles& surfaceAngles(const BakeSpec& spec, const MeshChoice& mesh,
                                 const HorizonShooter& shoot);
  /// Elliptical cones of light, fitted to the horizons of the bake.
  const GpuTable& ellipses(const BakeSpec& spec, StageClock& clock);

 private:
  const HorizonTables& bake(const BakeSpec& spec, StageClock& clock);

  const HeightField& field_;
  double texelsPerHeight_;
  Cache& cache_;
  SceneStore& store_;
  const RunKeys& keys_;
  // By the settings that enter each, see settingsKey.
  std::map<ContentKey, std::shared_ptr<const HorizonTables>> bakes_;
  std::map<ContentKey, std::shared_ptr<const TablePair>> stored_;
  std::map<ContentKey, GpuTable> ellipses_;
  std::map<ContentKey, GpuAngles> angles_;
  std::map<std::pair<MeshChoice, ContentKey>, std::shared_ptr<const GpuAngles>> surfaceAngles_;
};

/// Whether a bake is small enough to be kept.
bool keepsHorizons(const HeightField& field, const BakeSettings& settings);

/// bakeHorizons, or what the cache has of it.
HorizonTables keptHorizons(Cache& cache, const HeightField& field, const BakeSpec& bake,
                           const Progress& progress);

}  // namespace gnomon
