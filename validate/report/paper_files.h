#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/plots/line_plot.h"
#include "report/run_folder.h"
#include "report/tables/latex_table.h"
#include "report/tables/table.h"
#include "study/judge/ranking.h"
#include "study/judge/suite/suite_statistics.h"
#include "study/record/record.h"
#include "study/record/sweep_record.h"

namespace gnomon::report {

/// The keys by which columns of a paper's tables can be chosen: those of rankedTable and of
/// suiteRankedTable, each once. An interval's is "interval", that of a column without a key its
/// heading in small letters.
std::vector<std::string> paperColumnKeys();

/// The table with the chosen columns alone, as any paper shows it; as it is where it has none of
/// them or none is chosen. The names of its rows stay.
Table withColumns(Table table, const std::vector<std::string>& keys);

/// The table with the rows of these names alone, in its own order; as it is where it has none of
/// them or none is given.
Table withRows(Table table, const std::vector<std::string>& names);

/// The figures that a paper quotes, as macros of LaTeX: `\newcommand{\gnomonFigureEight…}{1.60}`, a
/// line each, with what it is as a comment. The texts are those of the tables, without units. Times
/// of frames are left out, since no two runs share them.
///
/// A name is `\gnomon`, the study's name, the method's label, and the figure: see latexName. Where
/// two would be the same, the later one ends in X.

/// Of a study: for each method rank, error rate with its interval and its ends, the parts, IoU,
/// BER and memory; the truth's uncertainty, prevalence, samples, light, views, search radius, step.
std::string numbersTex(const study::StudyRecord& record,
                       const std::vector<study::RankedMethod>& ranked);

/// Of a sweep: each method's mean, least and largest error rate, and of up to 100 cases its error
/// rate in each.
std::string numbersTex(const study::SweepRecord& sweep);

/// Of a suite: the columns of suiteRankedTable, and how many scenes it has.
std::string numbersTex(const study::SuiteStatistics& statistics);

/// A text as part of the name of a macro, which takes letters alone: each word with a capital, each
/// digit as a word, all else left out: "onoue-2004" is "OnoueTwoZeroZeroFour".
std::string latexName(std::string_view text);

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
