#pragma once

#include <vector>

#include "report/plots/plot_sheet.h"
#include "report/tables/frontier_table.h"

namespace gnomon::report {

/// The points as a plot, error against memory (both logarithmic), one series a method, the
/// efficient ones joined by steps.
/// @throws InternalError for a number that is not finite
PlotSheet frontierPlot(const std::vector<FrontierPoint>& points);

}  // namespace gnomon::report
