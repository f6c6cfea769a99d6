#pragma once

#include <string>
#include <vector>

#include "report/plots/line_plot.h"
#include "study/judge/suite/suite_statistics.h"

namespace gnomon::report {

/// The plots of a suite:
///   suite-errors     the share of a method's scenes with no more than an error, at every error on
///   a
///                    logarithmic axis. Errors below the left end stand at it.
///   suite-bins_AXIS  error in the bins of κh, of the light's elevation, of the reach of shadows
///                    and of the stretch of the texture, each bin with its interval over the
///                    scenes; none of an axis without bins
/// @param shown  labels of the methods that are drawn, in the order of the legend (plottedMethods)
/// @throws InternalError for a number that is not finite
std::vector<LinePlot> suitePlots(const study::SuiteStatistics& statistics,
                                 const std::vector<std::string>& shown);

/// The methods with a rank, each against each: the probability that the row's has the smaller error
/// on a new scene, in percent; blue above 50, orange below it. A pair that is not known to differ
/// has no colour, a grey figure and its differenceSign.
PlotSheet suiteWinsPlot(const study::SuiteStatistics& statistics);

}  // namespace gnomon::report
