#pragma once

#include <vector>

#include "report/plots/plot_sheet.h"
#include "study/record/sweep_record.h"

namespace gnomon::report {

/// The sections of a sweep's page that show plots, by PlotSheet::section.
constexpr const char* sweepErrorSection = "plots";
constexpr const char* sweepLightsSection = "lights";
constexpr const char* sweepCostSection = "cost";

/// All plots of a sweep.
/// @throws InternalError for a number that is not finite
std::vector<PlotSheet> sweepPlots(const study::SweepRecord& sweep, PlotPlace place);

}  // namespace gnomon::report
