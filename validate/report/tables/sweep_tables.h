#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "report/tables/latex_table.h"
#include "report/tables/table.h"
#include "study/record/sweep_record.h"

namespace gnomon::report {

/// Mean error rates in percent over lights and views, cases × methods, with the values of all swept
/// keys, tinted by size; the truth's uncertainty is the last column. A page has the names of the
/// cases too, which lead to their reports. A mean over fewer views and lights than others of its
/// row has a star.
Table sweepCasesTable(const study::SweepRecord& sweep);

/// What a method's mean error rates over lights and views are over the cases of a sweep, shares.
struct ErrorSpread {
  std::string method;
  std::optional<double> mean, least, largest;  ///< none where no case has an error rate
  std::size_t largestAt = 0;                   ///< the case, of all
  std::size_t cases = 0;                       ///< that have an error rate
};

/// Of every method, in the study's order.
std::vector<ErrorSpread> errorSpreads(const study::SweepRecord& sweep);

/// What the methods' mean error rates over lights and views are over all cases: their mean, the
/// least, the largest and where that is.
Table sweepSpreadTable(const study::SweepRecord& sweep);

/// The table that people read: of one key sweepErrorsTable while its columns fit `mostColumns`,
/// else sweepCasesTable while its rows fit `mostRows`, else sweepSpreadTable.
Table readableSweepTable(const study::SweepRecord& sweep, std::size_t mostColumns,
                         std::size_t mostRows);

/// The table for a paper: the first of sweepErrorsTable (of one key), sweepCasesTable (of up to 100
/// cases) and sweepSpreadTable that fits its room.
Table sweepPaperTable(const study::SweepRecord& sweep, const TabularRoom& room);

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
