#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/mask.h"
#include "study/record/record.h"
#include "study/run/scene/method_case.h"
#include "study/run/scene/run_scene.h"
#include "study/run/stages/budget.h"
#include "study/run/stages/run_writer.h"

namespace gnomon::study {

/// Runs the states of a study's ladders, each a real method with its real bake, beside the study's
/// methods, and attributes the errors. A state that several ladders share is run once.
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
  [[nodiscard]] std::string maskPath(std::size_t state, std::size_t light) const;
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
