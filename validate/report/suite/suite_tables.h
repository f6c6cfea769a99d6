#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "report/tables/table.h"
#include "study/judge/suite/suite_statistics.h"

namespace gnomon::report {

/// The statistics over the scenes of a suite as tables.

/// The methods, best mean first: the mean with its interval, median, quartiles, 95th percentile,
/// mean of the worst twentieth, the worst scene, the interval of the rank and its stability, and
/// the truth's uncertainty. Signs as differenceSign, against the first. Methods
/// that lack a scene stand apart.
Table suiteRankedTable(const study::SuiteStatistics& statistics);

/// Every other method beside that of rank 1, on the scenes that both have: the difference, p by
/// Holm, how often the first beats it, and the verdict. No row where no method has a rank.
Table suiteLeaderTable(const study::SuiteStatistics& statistics);

/// The scenes with the largest median of the methods' errors; each name leads to its report.
/// @param most  rows
Table suiteScenesTable(const study::SuiteStatistics& statistics, std::size_t most);

/// Error rates in percent, methods × bins of an axis, tinted by size. No row where no method has
/// bins on the axis.
Table suiteBinsTable(const study::SuiteStatistics& statistics, const std::string& axis);

/// What the errors of the scenes are.
struct SuiteFigure {
  const char* key;   ///< of the metric: "error_rate"; "mae" where lights have discs
  const char* name;  ///< "Error rate", or "Mean |ΔV|"
  const char* of;    ///< percent of this: "the samples", or "the light"
};
SuiteFigure suiteFigure(const study::SuiteStatistics& statistics);

/// For programs, a row a scene × method: scene, method, error_rate, false_shadow, false_light,
/// uncertainty, rank. The last is by the errors on that scene alone; it is empty, like error_rate,
/// where the method lacks a view or light of the scene.
Table suiteResultsTable(const study::SuiteStatistics& statistics,
                        std::span<const study::StudyMeans> studies);

/// The axes that have bins, in the order of sampleAxes.
std::vector<std::string> suiteAxes(const study::SuiteStatistics& statistics);

/// Three decimals: "0.012", "<0.001".
std::string probabilityText(double probability);

/// "1", or "1 to 3".
std::string rankText(std::size_t low, std::size_t high);

}  // namespace gnomon::report
