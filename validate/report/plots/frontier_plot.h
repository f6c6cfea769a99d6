#pragma once

#include <optional>
#include <vector>

#include "report/plots/method_styles.h"
#include "report/plots/plot_sheet.h"
#include "report/tables/frontier_table.h"

namespace gnomon::report {

/// The points as a plot, error against memory ("frontier"), against the time of a frame
/// ("frontier_time") or against the texels read ("frontier_texels"), both axes logarithmic, one
/// series a method, in the colour of the first of its entries that is highlighted, the efficient
/// ones joined by steps.
/// @param uncertainty  of the truth, shown as a band; none where it was not measured
/// @param isSoft  whether errors are shares of light (study::isSoft)
/// @throws InternalError for a number that is not finite
PlotSheet frontierPlot(const std::vector<FrontierPoint>& points, Price price,
                       const MethodStyles& styles, std::optional<double> uncertainty = {},
                       PlotPlace place = PlotPlace::paper, bool isSoft = false);

}  // namespace gnomon::report
