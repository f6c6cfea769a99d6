#pragma once

#include <span>
#include <string>
#include <vector>

#include "report/tables/table.h"
#include "study/judge/study_ranking.h"

namespace gnomon::report {

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
