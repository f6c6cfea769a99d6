#pragma once

#include <map>
#include <tuple>
#include <utility>

#include "relief/horizon_bake.h"
#include "render/gpu_scene.h"
#include "study/stage_clock.h"
#include "study/study_file.h"

namespace gnomon {

/// The horizon and distance table of one bake on the GPU, in the bits of one method.
struct TablePair {
  GpuTable horizon;
  GpuTable distance;
};

/// The tables that a study's methods ask for: every bake is done once, and stored once for each
/// number of bits. References stay valid while the set lives.
class TableSet {
 public:
  explicit TableSet(const HeightField& field) : field_(field) {}

  /// @param clock  of the stages "bake" and "tables"
  const TablePair& tables(const BakeSpec& spec, StageClock& clock);

 private:
  const HorizonTables& bake(const BakeSettings& settings, StageClock& clock);

  const HeightField& field_;
  std::map<std::pair<int, double>, HorizonTables> bakes_;           ///< azimuths, radius
  std::map<std::tuple<int, double, TableBits>, TablePair> stored_;  ///< and bits
};

}  // namespace gnomon
