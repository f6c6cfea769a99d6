#pragma once

#include <string>

#include "report/tables/table.h"
#include "study/record/sweep_record.h"

namespace gnomon::report {

/// The long table of a sweep or of a study, one figure a row: case, the swept keys, method, view,
/// light, answer, region, metric, value, low, high, uncertainty, unit.
///   case         the case's number from 1, in the order of the sweep; 1 of a study
///   value        never missing: a figure that is not defined has no row
///   low, high    95 % interval, where the metric has one: the score, the drawn error rate over all
///                samples
///   uncertainty  of the truth in this metric (uncertaintyIn), where it was measured
///   unit         share, correlation (-1 to 1), pixels, texels, ratio or count
/// Of the drawn answer it has every metric in every region, of the shadow test alone the three
/// error rates over all samples.

/// The rows of one case.
/// @param number  of the case, from 1
Table longTable(const std::vector<study::SweptKey>& keys, const study::SweepCase& which,
                std::size_t number, const study::StudyRecord& record);

/// All rows as CSV: a sweep's, of its cases in their order, or a study's.
std::string longCsv(const study::SweepRecord& sweep);
std::string longCsv(const study::StudyRecord& record);

}  // namespace gnomon::report
