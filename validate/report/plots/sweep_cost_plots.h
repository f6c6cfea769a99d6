#pragma once

#include <vector>

#include "report/plots/plot_sheet.h"
#include "report/plots/sweep_slices.h"
#include "study/record/sweep_record.h"

namespace gnomon::report {

/// What the values of a sweep of one dimension cost, one line a method:
///   sweep_frames  the time of a frame, ms (logarithmic), against the swept value; a value at which
///                 a method was not timed leaves a gap. Only where some method was timed.
///   sweep_memory  the mean error rate against the memory of tables and height map (both
///                 logarithmic), a point a value, from the lowest value to the highest. Only where
///                 some method's memory changes with the value.
/// @throws InternalError for a number that is not finite
/// @param slice  all cases
std::vector<PlotSheet> sweepCostPlots(const study::SweepRecord& sweep, const SweepSlice& slice,
                                      PlotPlace place = PlotPlace::paper);

}  // namespace gnomon::report
