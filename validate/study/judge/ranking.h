#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "study/judge/study_ranking.h"
#include "study/record/record.h"

namespace gnomon::study {

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

}  // namespace gnomon::study
