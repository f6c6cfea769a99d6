#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "study/record.h"
#include "study/sweep_record.h"

namespace gnomon {

/// One method in one study: means over its lights and views, each with the same weight, in the
/// region of all samples. Shares of the samples, 0 to 1; none where no light and view defines one.
struct MethodMeans {
  std::string label;
  std::string name;  ///< the method's own
  std::optional<double> errorRate, falseShadow, falseLight;
  std::optional<double> uncertainty;  ///< the truth's
};

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
/// draws another base mesh.
std::optional<double> largestUncertainty(const StudyMeans& study);

/// A method over the studies of a run. Methods of one label are one method.
struct RankedOverStudies {
  std::string label;
  std::vector<std::string> names;   ///< the methods' own, as a rule one
  std::optional<std::size_t> rank;  ///< 1 is best; none, if it was not measured in every study
  std::size_t studies = 0;          ///< in how many it has an error rate
  std::optional<double> meanError;  ///< over those, each study with the same weight
  std::optional<double> worstError;
  std::string worstStudy;
  std::optional<double> uncertainty;  ///< the truth's, mean over the same studies
  /// Without a rank: the mean error rate of the method of rank 1 over the same studies, which its
  /// own may be compared with.
  std::optional<double> leaderError;
  /// Not distinguishable from rank 1: by the mean of their differences over all studies, with the
  /// mean of the intervals' ends. Never without a difference in every study.
  bool closeToBest = false;
};

/// Methods from the lowest mean error rate to the highest. A mean over other studies says nothing
/// about who is better, so only methods that were measured in every study have a rank; the others
/// follow, those in more studies first, else in the order in which they appear.
std::vector<RankedOverStudies> rankOverStudies(std::span<const StudyMeans> studies);

/// The figures of a label in a study; nullptr where it has none.
const MethodMeans* findMeans(const StudyMeans& study, std::string_view label);

/// "onoue-2004", or "ours (onoue-2004)" where the label is not the method's own name.
std::string labelWithName(const RankedOverStudies& method);

}  // namespace gnomon
