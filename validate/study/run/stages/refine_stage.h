#pragma once

#include <memory>
#include <vector>

#include "study/record/record.h"
#include "study/run/scene/run_scene.h"
#include "study/run/scene/truth_stage.h"

namespace gnomon::study {

/// The surface that a study's truth is traced on, and how its step was found.
///
/// It is at the study's step. Or, where `[truth] uncertainty` is asked for, at a step found by
/// halving, from one texel on: each level is traced for every view of the standard base and every
/// light, and compared with the level before, as for the uncertainty of a run. The first level at
/// which the largest of these is at most what is asked for is the surface; the run's own
/// uncertainty is then that figure. One mesh is held at a time.
class TruthSurface {
 public:
  /// @param scene  outlives it
  explicit TruthSurface(RunScene& scene);
  TruthSurface(const TruthSurface&) = delete;
  TruthSurface& operator=(const TruthSurface&) = delete;
  ~TruthSurface() = default;

  /// The search, too, is made when the surface is first asked for, unless the cache has its result.
  /// @throws MemoryError or InputError naming the rate that has been reached, and why no finer
  ///   level can be had: its memory, or more than 10⁹ micro-triangles
  SurfaceOnDemand& onDemand() { return surface_; }
  /// What a run reports of it: sizes, and how the step was found.
  TruthRecord record();

 private:
  std::shared_ptr<const TracedSurface> make();
  bool findPath();

  RunScene& scene_;
  std::vector<RefinementRecord> path_;  ///< coarsest first; empty until it is known
  SurfaceOnDemand surface_;
};

}  // namespace gnomon::study
