#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/scenes/resampled_mean.h"
#include "study/record/record.h"
#include "study/record/sweep_record.h"

namespace gnomon::study {

/// What one scene gives to one bin of an axis for one method. The shares are means over the scene's
/// views, all lights together; those of an axis's bins add up to 1, and to the error rate over the
/// samples that have a value there.
struct SceneBin {
  std::string method;  ///< a label
  std::string axis;    ///< as in BinRecord, likewise `low` and `high`
  std::optional<double> low, high;
  compare::SceneShare share;
};

/// The suite that a study was drawn for, as its settings have it; empty for none.
std::string suiteNameOf(const StudyRecord& record);

/// Of every method and axis of a record, in the record's order.
std::vector<SceneBin> sceneBins(const StudyRecord& record);

/// One method in one study: means over its lights and views, each with the same weight, in the
/// region of all samples. Shares of the samples, 0 to 1; none where no light and view defines one.
/// Means over fewer cases (views under a light) than other methods of the study have cannot be
/// compared with theirs.
struct MethodMeans {
  std::string label;
  std::string name;  ///< the method's own
  std::optional<double> errorRate, falseShadow, falseLight;
  std::optional<double> uncertainty;  ///< the truth's
  /// Error rate in each case of the study in which some method has one; of a sweep in those of its
  /// first value, then of its second, and so on.
  std::vector<std::optional<double>> caseErrors = {};
  /// 95 % of `errorRate` in a study: the mean of the ends of its views' intervals, all lights
  /// together. Exact for one view; for several as if their errors were fully correlated, so never
  /// too narrow. None where a view has none, and for a sweep's mean.
  std::optional<compare::Interval> interval = std::nullopt;
  render::MethodMark mark = {};

  /// In how many of them it has one.
  [[nodiscard]] std::size_t cases() const;
  [[nodiscard]] bool isInEveryCase() const { return cases() == caseErrors.size(); }
};

/// The mark of a mean over fewer cases than others have, and its explanation.
constexpr const char* fewerCasesMark = "*";
constexpr const char* fewerCasesMeaning =
    "* mean over fewer views and lights than others have: not comparable.";

/// The part of a ranking that comes from one study.
struct StudyMeans {
  std::string name;  ///< also its folder beside the ranking
  std::string title;
  RunStatus status = RunStatus::notJudged;
  std::vector<MethodMeans> methods;
  std::vector<ClaimRecord> claims;
  /// Of every two methods that answer in one view: differenceOverViews, for a sweep the mean of it
  /// over the steps that have it.
  std::vector<DifferenceRecord> differences = {};
  /// Of a single study that was drawn for a suite: that suite's name, and what its samples give to
  /// the suite's bins. Empty for any other, and for a sweep.
  std::string suite = {};
  std::vector<SceneBin> bins = {};
  bool isSoft = false;  ///< a light has a disc: there an error is a `mae`
};

/// Whether a light has a disc: there an error is a share of light, `mae`.
bool isSoft(const StudyRecord& record);

/// The same of any step.
bool isSoft(const SweepRecord& sweep);

StudyMeans studyMeans(const StudyRecord& record);

/// A sweep as one study: each figure the mean over its steps, none where a step has none.
StudyMeans studyMeans(const SweepRecord& sweep);

/// The combined status: fail where one fails, pass where one passes and none fails.
RunStatus statusOf(std::span<const StudyMeans> studies);

/// The largest of the methods' means of the truth's uncertainty. They differ only where a method
/// answers in fewer cases.
std::optional<double> largestUncertainty(const StudyMeans& study);

/// The figures of a label in a study; nullptr where it has none.
const MethodMeans* findMeans(const StudyMeans& study, std::string_view label);

/// "shadow-volume", or "shadow-volume (2 of 4 cases)" where it lacks some: for legends.
std::string labelWithCases(const MethodMeans& method);

/// The labels of the studies' methods, each once, in the order in which they appear.
std::vector<std::string> labelsOf(std::span<const StudyMeans> studies);

/// In how many views under a light some method of the study has an error rate.
std::size_t caseCount(const StudyMeans& study);

/// The mean, if every value is known; none of no value.
std::optional<double> meanOf(const std::vector<std::optional<double>>& values);

/// The difference of two methods in a study, the first less the second; none where it has none.
std::optional<DifferenceRecord> differenceIn(const StudyMeans& study, std::string_view first,
                                             std::string_view second);

/// The method's rows of one answer over all samples, in the cases in which it has an error rate.
std::vector<const ResultRecord*> rankedRows(const StudyRecord& record, std::string_view method,
                                            Answer answer);

}  // namespace gnomon::study
