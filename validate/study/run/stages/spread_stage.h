#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "compare/counts.h"
#include "study/record/record.h"
#include "study/run/scene/method_case.h"
#include "study/run/scene/method_outcome.h"
#include "study/run/scene/run_scene.h"
#include "study/run/stages/confidence.h"

namespace gnomon::study {

/// Collects the errors of all methods in one view: block by block, for confidence intervals, and in
/// the bins of every axis.
class SpreadStage {
 public:
  /// @param methods  of the study; they outlive the stage
  SpreadStage(RunScene& scene, std::span<const MethodCase> methods, std::size_t view);

  /// The side of the cells that errors are summed in, samples.
  [[nodiscard]] int cellSide() const { return errors_.tiling.cellSide; }

  /// Adds a method's outcome under the next of the study's lights.
  /// @param method  its place in the study; one that answers in the view
  void add(std::size_t method, const MethodOutcome& outcome);

  /// Appends confidence, differences and bins of the view, all lights measured.
  void report(StudyRecord& record) const;

 private:
  [[nodiscard]] std::vector<BinRecord> bins() const;

  RunScene& scene_;
  ViewErrors errors_;
  std::vector<std::size_t> answering_;  ///< which methods those of `errors_` are
  /// [method of errors_][axis][bin], lights summed
  std::vector<std::vector<std::vector<compare::Counts>>> counts_;
};

}  // namespace gnomon::study
