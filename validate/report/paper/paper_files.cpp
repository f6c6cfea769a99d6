#include "report/paper/paper_files.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/lists.h"
#include "report/paper/paper_table.h"
#include "report/plots/study_plots.h"
#include "report/plots/sweep_plots.h"
#include "report/plotted_methods.h"
#include "report/suite/suite_plots.h"
#include "report/suite/suite_tables.h"
#include "report/tables/ranked_table.h"
#include "report/tables/sweep_tables.h"
#include "report/text/text_width.h"
#include "study/judge/ranking.h"

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

namespace {

/// The rows whose method is among the labels.
template <typename Rows, typename ValueIn>
Rows rowsOf(const Rows& rows, const std::vector<std::string>& labels, const ValueIn& valueIn) {
  Rows kept;
  for (const auto& row : rows) {
    if (contains(labels, valueIn(row))) kept.push_back(row);
  }
  return kept;
}

template <typename Rows>
bool holdsAny(const Rows& methods, const std::vector<std::string>& labels) {
  return std::any_of(methods.begin(), methods.end(),
                     [&](const auto& method) { return contains(labels, method.label); });
}

constexpr auto methodIn = [](const auto& row) { return row.method; };
constexpr auto labelIn = [](const auto& row) { return row.label; };

study::StudyRecord ofMethods(const study::StudyRecord& record,
                             const std::vector<std::string>& labels) {
  study::StudyRecord kept;
  kept.name = record.name;
  kept.title = record.title;
  kept.truth = record.truth;
  kept.atlasViews = record.atlasViews;
  const bool isChoice = holdsAny(record.methods, labels);
  std::vector<std::string> all;
  for (const study::MethodRecord& method : record.methods) all.push_back(method.label);
  const std::vector<std::string>& shown = isChoice ? labels : all;
  kept.methods = rowsOf(record.methods, shown, labelIn);
  kept.results = rowsOf(record.results, shown, methodIn);
  kept.confidence = rowsOf(record.confidence, shown, methodIn);
  kept.cost = rowsOf(record.cost, shown, methodIn);
  return kept;
}

}  // namespace

study::SweepRecord withMethods(const study::SweepRecord& sweep,
                               const std::vector<std::string>& labels) {
  study::SweepRecord kept;
  kept.name = sweep.name;
  kept.title = sweep.title;
  kept.keys = sweep.keys;
  kept.cases = sweep.cases;
  kept.hasStepReports = sweep.hasStepReports;
  for (const study::StudyRecord& step : sweep.steps) {
    kept.steps.push_back(ofMethods(step, labels));
  }
  return kept;
}

std::vector<std::string> paperPdfs(const std::vector<LinePlot>& plots, PaperWidth width,
                                   double fontSize) {
  constexpr double inch = 25.4;  // millimetres
  const double points = millimetresOf(width) * pointsOfMillimetre;
  std::vector<std::string> scripts;
  for (const LinePlot& plot : plots) {
    std::size_t longest = 24;  // "uncertainty of the truth"
    for (const PlotCurve& curve : plot.curves) {
      longest = std::max(longest, displayWidth(shortLegend(curve.label)));
    }
    // A character is half as wide as the font is high; the symbol takes as much as six.
    const double room = points / (0.5 * fontSize * static_cast<double>(longest + 6));
    const auto columns = static_cast<std::size_t>(std::clamp(room, 1.0, 4.0));
    const std::size_t rows = (plot.curves.size() + columns) / columns;
    const double height = (width == PaperWidth::column ? 70 : 84) +
                          1.3 * fontSize * static_cast<double>(rows) / pointsOfMillimetre;
    // At 0.8 its points are points. Small letters of the usual plain fonts are higher than a
    // paper's: at 0.68 they look alike.
    scripts.push_back(
        fmt::format("set encoding utf8\nset terminal pdfcairo size {:.3f}in,{:.3f}in noenhanced "
                    "font 'sans-serif,{:g}' fontscale 0.68 linewidth 0.5\n{}",
                    millimetresOf(width) / inch, height / inch, fontSize,
                    paperCommands(plot, fontSize, columns)));
  }
  return undatedPdfs(scripts);
}

}  // namespace gnomon::report
