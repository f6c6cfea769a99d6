#pragma once

#include <span>
#include <string>
#include <vector>

#include "report/tables/table.h"
#include "study/judge/ranking.h"

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

/// Error rates in percent, methods × studies, tinted by size, with the truth's uncertainty as the
/// last row; every study's heading leads to its report. A mean over fewer cases than others of its
/// column have has a star.
/// @param labels  of the methods, a row each
Table studyErrorsTable(const std::vector<std::string>& labels,
                       std::span<const study::StudyMeans> studies);

/// The same of a sweep: methods × cases, each by its name.
Table sweepErrorsTable(const study::SweepRecord& sweep);

/// The largest of the methods' error rates, which the tints are beside.
double worstErrorOf(std::span<const study::StudyMeans> studies);
/// A method's error rate, tinted by its size beside the largest.
/// @param means  nullptr where it was not evaluated
Cell meanErrorCell(const study::MethodMeans* means, double worst);

/// " * mean over fewer views and lights …", the star's meaning; empty where no cell has one.
std::string fewerCasesNote(std::span<const study::StudyMeans> studies);

/// For programs, a row a study × method: study, method, error_rate, false_shadow, false_light,
/// uncertainty, cases, all_cases.
Table studyMeansTable(std::span<const study::StudyMeans> studies);

/// Of a sweep, a row a case × method: instead of study the value, with several keys a column of
/// values for each; and bytes. It is without the times
/// of frames, which no two runs share.
Table sweepMeansTable(const study::SweepRecord& sweep);

}  // namespace gnomon::report
