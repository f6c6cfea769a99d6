#pragma once

#include <span>
#include <string>
#include <vector>

#include "report/tables/table.h"
#include "study/judge/ranking.h"
#include "study/judge/study_ranking.h"

namespace gnomon::report {

/// A study's methods from best to worst over all its cases: each error rate with its interval, the
/// truth's uncertainty and a bar of its two parts, the other means, memory and frame time. ≈ marks
/// a ranked method that is not distinguishable from the first.
/// @param ranked  rankMethods of the record
Table rankedTable(const study::StudyRecord& record, const std::vector<study::RankedMethod>& ranked);

/// What the errors of several studies are shares of: errorWhole, both where only some have a light
/// with a disc.
std::string errorWholeOver(std::span<const study::StudyMeans> studies);

/// The methods over all studies of a run: mean and worst error rate, the study it is worst on, in
/// how many cases it was measured, and the truth's mean uncertainty. Methods that lack a case stand
/// apart, without a rank, each with what the best one reaches on the same cases.
/// @param ranked  rankOverStudies of these studies
Table rankedOverStudiesTable(std::span<const study::StudyMeans> studies,
                             const std::vector<study::RankedOverStudies>& ranked);

}  // namespace gnomon::report
