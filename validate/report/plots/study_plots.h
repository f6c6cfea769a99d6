#pragma once

#include <string>
#include <vector>

#include "report/plots/line_plot.h"
#include "study/record/record.h"

namespace gnomon::report {

/// The plots of a study:
///   error-by-AXIS_VIEW  error rates in the bins of an axis of samples, all lights together, with
///                       the truth's uncertainty; none of one bin alone. A method without samples
///                       in a bin has a gap there.
///   frontier            error against the memory of tables and height map, both logarithmic, a
///                       point an entry, the efficient ones of all entries joined by steps
///   frontier_time       likewise against the time of a frame
/// Of the frontiers a method has all its entries, and the style of the one that is shown.
/// @param shown  labels of the methods that are drawn, in the order of the legend (plottedMethods)
/// @throws InternalError for a number that is not finite
std::vector<LinePlot> studyPlots(const study::StudyRecord& record,
                                 const std::vector<std::string>& shown);

}  // namespace gnomon::report
