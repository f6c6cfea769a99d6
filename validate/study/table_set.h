#pragma once

#include <map>
#include <tuple>
#include <utility>

#include "relief/horizon_bake.h"
#include "render/gpu_scene.h"
#include "study/stage_clock.h"
#include "study/study_file.h"
#include "surface/sample_grid.h"
#include "truth/micro_scene.h"

namespace gnomon {

/// The horizon and distance table of one bake on the GPU, in the bits of one method.
struct TablePair {
  GpuTable horizon;
  GpuTable distance;
};

/// What the displaced surface's own horizons are shot on.
struct HorizonScene {
  const LimitSurface& surface;
  const Relief& relief;
  const MicroMesh& mesh;
  const MicroScene& scene;
  const SampleGrid& texels;  ///< the samples at all texel centres of the surface
  glm::ivec2 origin;         ///< texel coordinates of the grid's lower left corner
};

/// The tables that a study's methods ask for: every bake is done once, and stored once for each
/// number of bits. References stay valid while the set lives.
class TableSet {
 public:
  explicit TableSet(const HeightField& field) : field_(field) {}

  /// @param clock  of the stages "bake" and "tables"
  const TablePair& tables(const BakeSpec& spec, StageClock& clock);
  /// Horizon angles of the flat relief.
  const GpuAngles& angles(const BakeSpec& spec, StageClock& clock);
  /// Horizon angles of the displaced surface.
  const GpuAngles& surfaceAngles(const BakeSpec& spec, const HorizonScene& scene,
                                 StageClock& clock);
  /// Elliptical cones of light, fitted to the horizons of the bake.
  const GpuTable& ellipses(const BakeSpec& spec, StageClock& clock);

 private:
  const HorizonTables& bake(const BakeSettings& settings, StageClock& clock);

  const HeightField& field_;
  std::map<std::pair<int, double>, HorizonTables> bakes_;  ///< azimuths, radius
  using Key = std::tuple<int, double, TableBits>;
  std::map<Key, TablePair> stored_;                                         ///< and bits
  std::map<Key, GpuTable> ellipses_;                                        ///< the same
  std::map<std::tuple<int, double, double, TableBits>, GpuAngles> angles_;  ///< and limit
  std::map<Key, GpuAngles> surfaceAngles_;  ///< azimuths, limit, bits
};

}  // namespace gnomon
