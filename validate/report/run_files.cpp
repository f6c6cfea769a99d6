#include "report/run_files.h"

#include <fmt/core.h>

#include <string>
#include <vector>

#include "report/json/summary_json.h"
#include "report/json/sweep_json.h"
#include "report/page/case_html.h"
#include "report/page/report_html.h"
#include "report/page/sweep_html.h"
#include "report/paper/paper_files.h"
#include "report/plots/study_plots.h"
#include "report/plots/sweep_plots.h"
#include "report/plotted_methods.h"
#include "report/tables/budget_table.h"
#include "report/tables/case_tables.h"
#include "report/tables/formats/csv_format.h"
#include "report/tables/formats/formats.h"
#include "report/tables/frontier_table.h"
#include "report/tables/long_table.h"
#include "report/tables/means_table.h"
#include "report/tables/ranked_table.h"

namespace gnomon::report {
namespace {

/// Draws the plots of the methods that they show, and writes them.
std::vector<DrawnPlot> writePlots(const std::vector<LinePlot>& plots, RunFolder& folder,
                                  cache::Cache& cache) {
  std::vector<DrawnPlot> drawn = drawPlots(sheetsOf(plots), &cache);
  for (const DrawnPlot& plot : drawn) {
    folder.write(fmt::format("plots/{}.svg", plot.sheet.name), plot.svg);
    folder.write(fmt::format("plots/{}.pdf", plot.sheet.name), plot.pdf);
  }
  return drawn;
}

}  // namespace

void writeRunFiles(const study::StudyRecord& record, const PaperOptions& paper, RunFolder& folder,
                   cache::Cache& cache) {
  folder.write("metrics.csv", csvTable(metricsTable(record)));
  const Table ranked = rankedTable(record, study::rankMethods(record));
  for (const TableFormat& format : tableFormats()) {
    if (format.isFile) folder.write(fmt::format("table.{}", format.name), format.print(ranked));
  }
  writePaperFiles(record, paper, folder);
  const auto writeRows = [&](const char* name, const Table& table) {
    if (!table.rows.empty()) folder.write(name, csvTable(table));
  };
  writeRows("bins.csv", binsTable(record));
  writeRows("frontier.csv", frontierTable(frontier(record, Price::memory)));
  writeRows("budget.csv", budgetPartsTable(record));
  const std::vector<DrawnPlot> plots =
      writePlots(studyPlots(record, plottedMethods(study::studyMeans(record))), folder, cache);
  for (const CasePage& page : casePages(record, folder.path())) {
    folder.write(page.file, page.page.text());
  }
  folder.write("report.html", reportHtml(record, folder.path(), plots).text());
  folder.finish(summaryJson(record));
}

void writeSweepFiles(const study::SweepRecord& sweep, const PaperOptions& paper, RunFolder& folder,
                     cache::Cache& cache) {
  folder.write("sweep.csv", csvTable(sweepMeansTable(sweep)));
  folder.write("cases.csv", longCsv(sweep));
  writePaperFiles(sweep, paper, folder);
  const std::vector<DrawnPlot> plots =
      writePlots(sweepPlots(sweep, plottedMethods(study::studyMeans(sweep))), folder, cache);
  folder.write("report.html", sweepHtml(sweep, plots).text());
  folder.finish(sweepJson(sweep));
}

}  // namespace gnomon::report
