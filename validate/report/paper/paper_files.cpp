#include "report/paper/paper_files.h"

#include <fmt/core.h>

#include <algorithm>

#include "report/paper/chosen_methods.h"
#include "report/paper/numbers_tex.h"
#include "report/paper/paper_plot.h"
#include "report/paper/paper_table.h"
#include "report/plots/study_plots.h"
#include "report/plots/sweep_plots.h"
#include "report/plotted_methods.h"
#include "report/suite/suite_plots.h"
#include "report/suite/suite_tables.h"
#include "report/tables/ranked_table.h"
#include "report/tables/sweep_tables.h"
#include "study/judge/ranking.h"
#include "study/judge/study_means.h"

namespace gnomon::report {
namespace {

/// figures/column/NAME.pdf, and likewise of a page.
void writeFigures(const std::vector<LinePlot>& plots, const PaperOptions& options,
                  RunFolder& folder) {
  for (const PaperWidth width : options.widths) {
    const std::vector<std::string> pdfs = paperPdfs(plots, width, options.fontSize);
    for (std::size_t i = 0; i < plots.size(); ++i) {
      folder.write(fmt::format("figures/{}/{}.pdf", paperWidthName(width), plots[i].name), pdfs[i]);
    }
  }
}

/// The table for a column, and where figures for a page are wanted that for a page.
/// @param prefix   of the files' names
/// @param tableOf  what fits a room
template <typename TableOf>
void writeTables(const std::string& prefix, const PaperOptions& options, const TableOf& tableOf,
                 RunFolder& folder) {
  const auto write = [&](const std::string& name, PaperWidth width) {
    const TabularRoom room = roomOf(width, options.fontSize);
    folder.write(prefix + name, latexTabular(tableOf(room), room));
  };
  write("table.tex", PaperWidth::column);
  const bool isWide = std::find(options.widths.begin(), options.widths.end(), PaperWidth::page) !=
                      options.widths.end();
  if (isWide) write("table-page.tex", PaperWidth::page);
}

}  // namespace

void writePaperFiles(const study::StudyRecord& record, const PaperOptions& options,
                     RunFolder& folder) {
  const std::vector<study::RankedMethod> ranked = study::rankMethods(record);
  Table table =
      withRows(withColumns(rankedTable(record, ranked), options.columns), options.methods);
  writeTables(
      "", options, [&](const TabularRoom&) { return table; }, folder);
  folder.write("numbers.tex", numbersTex(record, ranked));
  if (options.widths.empty()) return;
  const auto shown = plottedMethods(study::studyMeans(record), options.methods);
  writeFigures(studyPlots(record, shown), options, folder);
}

void writePaperFiles(const study::SweepRecord& sweep, const PaperOptions& options,
                     RunFolder& folder) {
  const study::SweepRecord chosen = withMethods(sweep, options.methods);
  writeTables(
      "", options, [&](const TabularRoom& room) { return sweepPaperTable(chosen, room); }, folder);
  folder.write("numbers.tex", numbersTex(sweep));
  if (options.widths.empty()) return;
  const auto shown = plottedMethods(study::studyMeans(sweep), options.methods);
  writeFigures(sweepPlots(sweep, shown), options, folder);
}

void writePaperFiles(const study::SuiteStatistics& statistics, const PaperOptions& options,
                     RunFolder& folder) {
  Table table =
      withRows(withColumns(suiteRankedTable(statistics), options.columns), options.methods);
  writeTables(
      "suite-", options, [&](const TabularRoom&) { return table; }, folder);
  folder.write("suite-numbers.tex", numbersTex(statistics));
  if (options.widths.empty()) return;
  writeFigures(suitePlots(statistics, plottedMethods(statistics, options.methods)), options,
               folder);
}

}  // namespace gnomon::report
