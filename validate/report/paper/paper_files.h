#pragma once

#include "report/paper/paper_options.h"
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

}  // namespace gnomon::report
