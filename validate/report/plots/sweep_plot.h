#pragma once

#include "report/plots/plot_sheet.h"
#include "study/record/sweep_record.h"

namespace gnomon {

/// A sweep as a plot: the mean error rate over lights and views against the swept value, one line a
/// method, and below it its two parts, false shadow and false light; in each the truth's mean
/// uncertainty as a grey band from 0. Values stand in increasing order, and the legend in the order
/// of the lines at the last of them. A figure that is not defined leaves a gap.
/// @throws InternalError for a number that is not finite
PlotSheet sweepPlot(const SweepRecord& sweep);

}  // namespace gnomon
