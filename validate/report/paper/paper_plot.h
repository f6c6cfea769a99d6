#pragma once

#include <string>
#include <vector>

#include "report/paper/paper_options.h"
#include "report/plots/line_plot.h"

namespace gnomon::report {

/// Plots as figures of a paper, a PDF of one page each: as wide as asked for, the legend below, all
/// text in one size. Same plots, same bytes.
/// @param fontSize  points
/// @throws InternalError as drawByGnuplot
std::vector<std::string> paperPdfs(const std::vector<LinePlot>& plots, PaperWidth width,
                                   double fontSize);

}  // namespace gnomon::report
