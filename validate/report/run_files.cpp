#include "report/run_files.h"

#include <array>
#include <string>
#include <vector>

#include "common/atomic_file.h"
#include "report/bin_files.h"
#include "report/budget_files.h"
#include "report/frontier.h"
#include "report/metrics_csv.h"
#include "report/report_html.h"
#include "report/study_plots.h"
#include "report/summary_json.h"
#include "report/sweep_files.h"
#include "report/sweep_html.h"
#include "report/sweep_plot.h"
#include "report/table_files.h"

namespace gnomon {
namespace fs = std::filesystem;
namespace {

/// The last two are where plots lay before they had a folder.
constexpr std::array files = {"summary.json", "report.html",  "metrics.csv", "bins.csv",
                              "sweep.csv",    "frontier.csv", "budget.csv",  "table.csv",
                              "table.tex",    "sweep.svg",    "frontier.svg"};
constexpr const char* plotFolder = "plots";

DrawnPlot writePlot(PlotSheet sheet, const fs::path& folder) {
  std::string svg = svgOf(sheet);
  writeTextAtomically(folder / plotFolder / (sheet.name + ".svg"), svg);
  writeTextAtomically(folder / plotFolder / (sheet.name + ".pdf"), pdfOf(sheet));
  return {std::move(sheet), std::move(svg)};
}

}  // namespace

void removeRunFiles(const fs::path& folder) {
  std::error_code ignored;
  for (const char* name : files) fs::remove(folder / name, ignored);
  std::vector<fs::path> plots;
  for (const auto& entry : fs::directory_iterator(folder / plotFolder, ignored)) {
    const std::string kind = entry.path().extension().string();
    if (kind == ".svg" || kind == ".pdf") plots.push_back(entry.path());
  }
  for (const fs::path& plot : plots) fs::remove(plot, ignored);
}

void writeRunFiles(const StudyRecord& record, const fs::path& folder) {
  writeTextAtomically(folder / "metrics.csv", metricsCsv(record));
  writeTextAtomically(folder / "table.csv", tableCsv(record));
  writeTextAtomically(folder / "table.tex", tableTex(record));
  if (!record.bins.empty()) writeTextAtomically(folder / "bins.csv", binsCsv(record));
  const std::vector<FrontierPoint> points = frontier(record);
  if (!points.empty()) writeTextAtomically(folder / "frontier.csv", frontierCsv(points));
  if (!record.budgets.empty()) writeTextAtomically(folder / "budget.csv", budgetCsv(record));
  std::vector<DrawnPlot> plots;
  for (PlotSheet& sheet : studyPlots(record)) {
    plots.push_back(writePlot(std::move(sheet), folder));
  }
  writeTextAtomically(folder / "report.html", reportHtml(record, folder, plots));
  writeTextAtomically(folder / "summary.json", summaryJson(record));
}

void writeSweepFiles(const SweepRecord& sweep, const fs::path& folder) {
  writeTextAtomically(folder / "sweep.csv", sweepCsv(sweep));
  const DrawnPlot plot = writePlot(sweepPlot(sweep), folder);
  writeTextAtomically(folder / "report.html", sweepHtml(sweep, plot.svg));
  writeTextAtomically(folder / "summary.json", sweepJson(sweep));
}

}  // namespace gnomon
