#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "study/record/record.h"
#include "study/record/sweep_record.h"

namespace gnomon {

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

  /// In how many of them it has one.
  [[nodiscard]] std::size_t cases() const;
  [[nodiscard]] bool isInEveryCase() const { return cases() == caseErrors.size(); }
};

/// Behind a mean over fewer cases than others beside it, and what that says.
constexpr const char* fewerCasesMark = "*";
constexpr const char* fewerCasesMeaning =
    "* mean over fewer views and lights than others have: not comparable.";

/// What one study of a run gives to a ranking over all of them.
struct StudyMeans {
  std::string name;  ///< also its folder beside the ranking
  std::string title;
  RunStatus status = RunStatus::notJudged;
  std::vector<MethodMeans> methods;
  std::vector<ClaimRecord> claims;
  /// Of every two methods that answer in one view: differenceOverViews, for a sweep the mean of it
  /// over the steps that have it.
  std::vector<DifferenceRecord> differences = {};
};

StudyMeans studyMeans(const StudyRecord& record);

/// A sweep as one study: each figure the mean over its steps, none where a step has none.
StudyMeans studyMeans(const SweepRecord& sweep);

/// What the statuses say together: fail where one does, pass where one does and none fails.
RunStatus statusOf(std::span<const StudyMeans> studies);

/// The largest of the methods' means of the truth's uncertainty. They differ only where a method
/// answers in fewer cases.
std::optional<double> largestUncertainty(const StudyMeans& study);

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
  /// Why it is not distinguishable from rank 1, by the mean of their differences over all studies
  /// with the mean of the intervals' ends: "no interval of the difference on bumps (at 0.5: the
  /// view has too few blocks of samples)", "the interval of the difference holds 0". None where it
  /// is, or where a study has no difference.
  std::optional<std::string> closeToBest;
};

/// Methods in the order of rankByError over the cases of all studies, else in the order in which
/// they appear.
std::vector<RankedOverStudies> rankOverStudies(std::span<const StudyMeans> studies);

/// The figures of a label in a study; nullptr where it has none.
const MethodMeans* findMeans(const StudyMeans& study, std::string_view label);

/// "shadow-volume", or "shadow-volume (2 of 4 cases)" where it lacks some: for legends.
std::string labelWithCases(const MethodMeans& method);

/// "onoue-2004", or "ours (onoue-2004)" where the label is not the method's own name.
std::string labelWithName(const RankedOverStudies& method);

}  // namespace gnomon
