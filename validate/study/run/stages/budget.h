#pragma once

#include <cstddef>
#include <optional>
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
#include "study/run/stages/run_writer.h"
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

/// What a budget is made of, apart from the errors of its states.
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

/// Runs the states of a study's ladders, each a real method with its real bake, along with the
/// study's methods, and attributes the errors. A state that several ladders share is run once.
class LadderStage {
 public:
  /// Prepares all states. Without a ladder there is nothing to do, here or later.
  /// @param surface  for tables that are shot on it; outlives the stage
  /// @param writer   gets the masks of the states
  /// @throws InputError as prepareMethod, or for a state that has no answer in an atlas
  LadderStage(RunScene& scene, SurfaceOnDemand& surface, RunWriter& writer);

  /// For tables that are shot on the displaced surface.
  [[nodiscard]] std::span<MethodCase> states() { return states_; }
  /// The view whose errors are attributed: the first atlas; none without a ladder.
  [[nodiscard]] std::optional<std::size_t> view() const { return view_; }

  /// Measures all states under one light.
  /// @param answers  of the study's methods in that view and light
  /// @throws InputError for a ladder whose first state is not its method
  void measure(std::size_t light, const std::vector<std::optional<CaseAnswers>>& answers);

  /// A budget a ladder: of all lights together if there are several, then of each.
  /// @param truth  its flip rates
  [[nodiscard]] std::vector<BudgetRecord> attribute(const TruthRecord& truth) const;

 private:
  void addState(const MethodSpec& spec, SurfaceOnDemand& surface, const std::string& method);
  [[nodiscard]] std::size_t stateOf(const MethodSpec& spec) const;
  void requireStarts(std::size_t state, const CaseAnswers& found,
                     const std::vector<std::optional<CaseAnswers>>& answers) const;
  [[nodiscard]] std::string maskName(std::size_t state, std::size_t light) const;
  [[nodiscard]] std::vector<StateErrors> errorsAlong(const std::vector<MethodSpec>& way,
                                                     std::span<const std::size_t> lights) const;
  [[nodiscard]] double uncertaintyOf(const TruthRecord& truth,
                                     std::span<const std::size_t> lights) const;
  [[nodiscard]] BudgetRecord attribute(const LadderSpec& ladder, const std::string& name,
                                       std::span<const std::size_t> lights,
                                       const TruthRecord& truth) const;

  RunScene& scene_;
  RunWriter& writer_;
  std::optional<std::size_t> view_;
  compare::Tiling tiling_;                        ///< of that view
  std::vector<MethodCase> states_;                ///< of all ladders, without repetition
  std::vector<std::vector<StateErrors>> errors_;  ///< [light][state]
};

}  // namespace gnomon::study
