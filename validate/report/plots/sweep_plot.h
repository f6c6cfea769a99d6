#pragma once

#include "report/plots/plot_sheet.h"
#include "report/plots/sweep_slices.h"
#include "study/record/sweep_record.h"

namespace gnomon::report {

/// A slice of a sweep as a plot: the mean error rate over lights and views against the swept value,
/// one line a method, with its 95 % intervals as bars; and below it its two parts, false shadow and
/// false light; in each the truth's mean uncertainty as a grey band from 0. The legend stands in
/// the order of the lines at the last value. A figure that is not defined leaves a gap.
/// @throws InternalError for a number that is not finite
PlotSheet sweepPlot(const study::SweepRecord& sweep, const SweepSlice& slice,
                    PlotPlace place = PlotPlace::paper);

}  // namespace gnomon::report
