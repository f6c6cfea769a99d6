#pragma once

#include <vector>

#include "report/plots/study_plots.h"
#include "report/text/html.h"
#include "study/record/sweep_record.h"

namespace gnomon {

/// A sweep as one page that loads nothing: its plots, the error rates of methods × values tinted by
/// size, its claims and the thresholds that failed. It links to the reports of its steps, whose
/// folders lie beside it.
/// @param plots  error against the value, then what the values cost: embedded
/// @throws InternalError for a number that is not finite
Html sweepHtml(const SweepRecord& sweep, const std::vector<DrawnPlot>& plots);

}  // namespace gnomon
