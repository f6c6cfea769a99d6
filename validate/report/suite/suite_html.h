#pragma once

#include <string_view>
#include <vector>

#include "report/plots/drawn_plots.h"
#include "report/text/html.h"
#include "study/judge/suite/suite_statistics.h"

namespace gnomon::report {

/// The statistics over the scenes of a suite as one page that loads nothing: the ranked methods,
/// their errors as curves, who beats whom, where methods fail, and the hardest scenes. It lies
/// beside the scenes' folders and links to their reports.
/// @param plots    suitePlots of the statistics
/// @param command  reproduces the run
/// @throws InternalError for a number that is not finite
Html suiteHtml(const study::SuiteStatistics& statistics, const std::vector<DrawnPlot>& plots,
               std::string_view command);

}  // namespace gnomon::report
