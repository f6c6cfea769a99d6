#pragma once

#include <vector>

#include "report/plots/plot_sheet.h"
#include "study/record/record.h"

namespace gnomon::report {

/// All plots of a study: error against memory, where there is something to trade; error by the bins
/// of every axis in every view; the error budgets of all lights together and of each of several.
/// Names are distinct.
/// @throws InternalError as the plots
std::vector<PlotSheet> studyPlots(const study::StudyRecord& record,
                                  PlotPlace place = PlotPlace::paper);

}  // namespace gnomon::report
