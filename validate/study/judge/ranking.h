#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "study/judge/distinguish.h"
#include "study/judge/study_means.h"
#include "study/record/record.h"
#include "study/record/sweep_record.h"
#include "study/spec/sweep/sweep.h"

namespace gnomon::study {

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
