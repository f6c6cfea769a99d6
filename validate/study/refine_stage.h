#pragma once

#include <memory>
#include <vector>

#include "study/record.h"
#include "study/run_scene.h"
#include "study/truth_stage.h"

namespace gnomon {

/// The surface that a study's truth is traced on.
struct TruthSurface {
  std::unique_ptr<const TracedSurface> surface;
  /// How its step was found, coarsest first; empty where the study does not ask for an uncertainty.
  std::vector<RefinementRecord> path;
};

/// At the study's step. Or, where `[truth] uncertainty` is asked for, at a step found by halving,
/// from one texel on: each level is traced for every view of the standard base and every light, and
/// held against the level before, as the uncertainty of a run is. The first level at which the
/// largest flip rate is at most what is asked for is the surface; the run's own uncertainty is then
/// that rate. One mesh is held at a time.
/// @throws MemoryError or InputError naming the rate that has been reached, and why no finer level
///   can be had: its memory, or more than 10⁹ micro-triangles
TruthSurface makeTruthSurface(RunScene& scene);

/// What a run reports of it: sizes, and how the step was found.
TruthRecord recordOf(const TruthSurface& made, const StudySpec& study);

}  // namespace gnomon
