#pragma once

#include <optional>
#include <vector>

#include "report/plots/plot_sheet.h"
#include "study/judge/suite/suite_statistics.h"

namespace gnomon::report {

/// Errors over the scenes, a curve a method: at every error, on a logarithmic axis, the share of
/// the method's scenes with no more than that. Errors below the left end stand at it.
/// @throws InternalError for a number that is not finite
PlotSheet suiteErrorsPlot(const study::SuiteStatistics& statistics,
                          PlotPlace place = PlotPlace::paper);

/// The methods with a rank, each against each: the probability that the row's has the smaller error
/// on a new scene, in percent; blue above 50, orange below it. A pair that is not known to differ
/// has no colour, a grey figure and its differenceSign.
PlotSheet suiteWinsPlot(const study::SuiteStatistics& statistics,
                        PlotPlace place = PlotPlace::paper);

/// Error against the light's elevation, κh, the reach of shadows and the stretch of the texture: a
/// panel each, with the highlighted methods that have a rank, each bin with its interval
/// over the scenes. None where no method has bins there.
std::optional<PlotSheet> suiteBinsPlot(const study::SuiteStatistics& statistics,
                                       PlotPlace place = PlotPlace::paper);

/// All of them that can be drawn.
std::vector<PlotSheet> suitePlots(const study::SuiteStatistics& statistics,
                                  PlotPlace place = PlotPlace::paper);

}  // namespace gnomon::report
