#pragma once

#include <string>
#include <vector>

#include "report/plots/line_plot.h"
#include "study/record/sweep_record.h"

namespace gnomon::report {

/// Sections of a sweep's page that have plots.
constexpr const char* sweepErrorSection = "plot";
constexpr const char* sweepCostSection = "cost";

/// The plots of a sweep:
///   sweep, sweep_2 …  a slice each (slicesOf): the mean error rate over lights and views against
///                     the swept value, with 95 % intervals, and the truth's uncertainty. A figure
///                     that is not defined leaves a gap.
///   sweep_memory      of one dimension: the mean error rate against the memory of tables and
///   height
///                     map, both logarithmic, from the lowest value to the highest. Of the methods
///                     whose memory changes with the value, if there is one.
/// @param shown  labels of the methods that are drawn, in the order of the legend (plottedMethods)
/// @throws InternalError for a number that is not finite
std::vector<LinePlot> sweepPlots(const study::SweepRecord& sweep,
                                 const std::vector<std::string>& shown);

}  // namespace gnomon::report
