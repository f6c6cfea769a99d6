#pragma once

#include <optional>

#include "report/plots/plot_sheet.h"
#include "study/record/sweep_record.h"

namespace gnomon::report {

/// A sweep over a grid (isGrid) as maps: a panel a method, in which the colour of each case is the
/// mean error rate over lights and views, by one scale for all panels. A figure that is not defined
/// leaves a gap.
/// @throws InternalError for a number that is not finite
PlotSheet sweepMapPlot(const study::SweepRecord& sweep, PlotPlace place = PlotPlace::paper);

}  // namespace gnomon::report
