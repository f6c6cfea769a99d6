#pragma once

#include <vector>

#include "report/plots/drawn_plots.h"
#include "report/text/html.h"
#include "study/record/sweep_record.h"

namespace gnomon::report {

/// A sweep as one page that loads nothing: its plots, the error rates of methods and cases tinted
/// by size, its claims and the thresholds that failed. It links to the reports of its steps, whose
/// folders lie beside it.
/// @param plots  by their sections: embedded. Without any the page says why
/// @throws InternalError for a number that is not finite
Html sweepHtml(const study::SweepRecord& sweep, const std::vector<DrawnPlot>& plots);

}  // namespace gnomon::report
