#pragma once

#include <vector>

#include "report/plots/plot_sheet.h"
#include "report/tables/frontier_table.h"

namespace gnomon::report {

/// The points as a plot, error against memory ("frontier") or against the time of a frame
/// ("frontier_time"), both axes logarithmic, one series a method, the efficient ones joined by
/// steps.
/// @throws InternalError for a number that is not finite
PlotSheet frontierPlot(const std::vector<FrontierPoint>& points, Price price);

}  // namespace gnomon::report
