#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "compare/confidence_interval.h"
#include "compare/counts.h"
#include "study/record/record.h"
#include "study/run/scene/method_case.h"
#include "study/run/scene/method_outcome.h"
#include "study/run/scene/run_scene.h"

namespace gnomon::study {

/// One method's errors in one view, in the cells of the view's tiling.
struct MethodErrors {
  std::string method;                        ///< a MethodRecord's label
  std::vector<compare::BlockErrors> lights;  ///< one a light of the study
};

/// All methods' errors in one view, and how the view is cut.
struct ViewErrors {
  std::string view;
  compare::Tiling tiling;
  std::vector<std::string> lights;
  std::vector<MethodErrors> methods;  ///< those that answer in this view
};

/// Every method's interval for all lights together and, where there are several, under each.
/// @throws InternalError as rateConfidence
std::vector<ConfidenceRecord> confidenceOf(const ViewErrors& errors);

/// Every two methods, each with every later one: for all lights together and, where there are
/// several, under each.
/// @param uncertainties  of the truth in this view, one a light; all lights together have the mean
/// @throws InternalError as differenceConfidence
std::vector<DifferenceRecord> differencesOf(const ViewErrors& errors,
                                            const std::vector<double>& uncertainties);

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
