#pragma once

#include <string>
#include <vector>

#include "report/paper/paper_options.h"
#include "report/plots/line_plot.h"
#include "report/run_folder.h"
#include "study/judge/suite/suite_statistics.h"
#include "study/record/record.h"
#include "study/record/sweep_record.h"

namespace gnomon::report {

/// What a run writes for a paper: always table.tex, a bare tabular that fits a column (see
/// latexTabular), and numbers.tex (see numbersTex); where figures are wanted,
/// figures/column/NAME.pdf (see paperFigure), and of a page likewise, with table-page.tex.
/// They show the chosen methods; without a choice the tables show all of them, the figures those
/// that plots show.
/// @throws InputError for a file that cannot be written; InternalError as the writers

void writePaperFiles(const study::StudyRecord& record, const PaperOptions& options,
                     RunFolder& folder);
void writePaperFiles(const study::SweepRecord& sweep, const PaperOptions& options,
                     RunFolder& folder);
/// A suite's names begin with `suite-`: it shares its folder with the ranking.
void writePaperFiles(const study::SuiteStatistics& statistics, const PaperOptions& options,
                     RunFolder& folder);

/// What the table of a sweep is made of, of some methods alone. All methods where `labels` holds
/// none of them.
study::SweepRecord withMethods(const study::SweepRecord& sweep,
                               const std::vector<std::string>& labels);

/// Plots as figures of a paper, a PDF of one page each: as wide as asked for, the legend below, all
/// text in one size. Same plots, same bytes.
/// @param fontSize  points
/// @throws InternalError as drawByGnuplot
std::vector<std::string> paperPdfs(const std::vector<LinePlot>& plots, PaperWidth width,
                                   double fontSize);

}  // namespace gnomon::report
