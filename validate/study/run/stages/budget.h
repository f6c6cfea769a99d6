#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/mask.h"
#include "compare/confidence_interval.h"
#include "compare/counts.h"
#include "study/record/record.h"
#include "study/run/scene/method_case.h"
#include "study/run/scene/method_outcome.h"
#include "study/run/scene/run_scene.h"
#include "study/run/stages/confidence.h"
#include "study/spec/study_file.h"
#include "truth/shadow_tracer.h"

namespace gnomon::study {

/// The names of what is left when all causes are corrected, in order: regions, and "other". A wrong
/// sample counts in the first that it is in: `global`, which no march or table over the map can
/// know; `distant`; `seam`.
const std::vector<std::string_view>& budgetRestNames();

/// The errors of one state of a ladder, in the cells of a tiling: under one light, or summed over
/// several in the same view.
struct StateErrors {
  compare::BlockErrors wrong;
  /// Those of them that are in the first regions of `budgetRestNames`, each but the last.
  std::vector<compare::BlockErrors> rest;
  compare::Counts counts;

  StateErrors& operator+=(const StateErrors& other);
};

/// @throws InputError as blockErrors
StateErrors stateErrors(const Mask& mask, const truth::Truth& truth,
                        const std::vector<double>& weights, const compare::Tiling& tiling);
/// The same of shares of a light's disc.
StateErrors stateErrors(const Visibility& map, const truth::Truth& truth,
                        const std::vector<double>& weights, const compare::Tiling& tiling);

/// What a budget is made of, beside the errors of its states.
struct BudgetCase {
  std::string view;
  std::string light;
  double uncertainty = 0;  ///< of the truth
  compare::Tiling tiling;  ///< of the view
};

/// Attributes an error to its causes: the share of a cause is the error rate before it is corrected
/// minus that after, and what is left at the end is split by region. By construction
/// the shares of either order and the rest add up to the error rate of the first state. Intervals
/// are those of `differenceConfidence`: a step's two states are compared block by block.
/// @param forward, backward  errors of the ladder's states
/// @throws InternalError where their number is not that of the causes and one more, and as
///   differenceConfidence
BudgetRecord attributeError(const LadderSpec& ladder, const BudgetCase& which,
                            const std::vector<StateErrors>& forward,
                            const std::vector<StateErrors>& backward);

/// How much of the error is another cause's in the other order: ½ Σ |forward - backward|.
double orderDependence(const BudgetRecord& budget);

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
