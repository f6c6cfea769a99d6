#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/scenes/resampled_mean.h"
#include "study/judge/distinguish.h"
#include "study/record/record.h"
#include "study/record/sweep_record.h"
#include "study/spec/sweep/sweep.h"

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

/// A method over the studies of a run. Methods of one label are one method.
struct RankedOverStudies {
  std::string label;
  std::vector<std::string> names;   ///< the methods' own, as a rule one
  std::optional<std::size_t> rank;  ///< 1 is best; none, if it lacks a case of some study
  std::size_t studies = 0;          ///< in how many it has an error rate
  std::size_t cases = 0;            ///< in how many views under a light of all studies together
  std::size_t allCases = 0;         ///< in which some method has one
  std::optional<double> meanError;  ///< over its studies, each with the same weight
  std::optional<double> worstError;
  std::string worstStudy;
  std::optional<double> uncertainty;  ///< the truth's, mean over the same studies
  /// Without a rank: the mean error rate of the method of rank 1 over the same cases, which its own
  /// may be compared with.
  std::optional<double> leaderError;
  /// Its difference to the method of rank 1: meanDifference over all studies, whose reason names
  /// the first study without an interval. None for rank 1 itself, for a method without a rank, and
  /// where a study has no difference.
  std::optional<DifferenceRecord> toBest;
};

/// The rule of all rankings, of a study and over the studies of a run, in every format. A case is
/// one view under one light. Means over different cases cannot be compared, so a method has a rank
/// only if it has an error rate in *every* case in which some method has one. Ranked methods come
/// first, from the lowest mean error to the highest; equal ones keep their order. The others follow
/// without a rank, those with more cases first, else in their order; `leaderError` is what their
/// mean may be compared with.
std::vector<RankedOverStudies> rankOverStudies(std::span<const StudyMeans> studies);

/// What a method is labelled and what it is: "ours (onoue-2004)"; the label alone where it says so
/// itself, "onoue-2004" or "onoue-2004, 16 azimuths".
/// @param names  those of all methods that have the label
std::string labelWithName(const std::string& label, const std::vector<std::string>& names);

/// A metric averaged over cases, each with the same weight.
struct Mean {
  std::optional<double> value;  ///< over the cases that define it; none, if no case does
  std::size_t cases = 0;        ///< how many those are
};

/// A method in a study: its place in the ranking of this study alone, and means over all lights and
/// views, in the region of all samples. A case is one view under one light.
struct RankedMethod : RankedOverStudies {
  MethodMeans means;  ///< of its drawn answers
  Mean iou, ber;      ///< likewise
  Mean testError;     ///< error rate of the shadow test alone
  LikeMethods like;   ///< of the study's methods, by differenceOverViews
};

/// The methods in the order of rankOverStudies over this study alone.
std::vector<RankedMethod> rankMethods(const StudyRecord& record);

/// The sweep of a plan, of which `steps` are the records in the plan's order; its claims judged.
/// @throws InternalError where the number of records is not that of the cases
SweepRecord makeSweepRecord(const StudyPlan& plan, std::vector<StudyRecord> steps,
                            const std::string& command);

}  // namespace gnomon::study
