#include "report/run_files.h"

#include <array>
#include <string>
#include <vector>

#include "common/atomic_file.h"
#include "common/parallel.h"
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

/// Both formats of all plots, each drawn by a process of its own.
std::vector<DrawnPlot> writePlots(std::vector<PlotSheet> sheets, const fs::path& folder) {
  std::vector<DrawnPlot> plots;
  for (PlotSheet& sheet : sheets) plots.push_back({std::move(sheet), ""});
  parallelFor(0, 2 * plots.size(), [&](std::size_t k) {
    auto& [sheet, svg] = plots[k / 2];
    const fs::path file = folder / plotFolder / sheet.name;
    if (k % 2 == 0) {
      svg = svgOf(sheet);
      writeTextAtomically(file.string() + ".svg", svg);
    } else {
      writeTextAtomically(file.string() + ".pdf", pdfOf(sheet));
    }
  });
  return plots;
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
  const std::vector<DrawnPlot> plots = writePlots(studyPlots(record), folder);
  writeTextAtomically(folder / "report.html", reportHtml(record, folder, plots));
  writeTextAtomically(folder / "summary.json", summaryJson(record));
}

void writeSweepFiles(const SweepRecord& sweep, const fs::path& folder) {
  writeTextAtomically(folder / "sweep.csv", sweepCsv(sweep));
  const std::vector<DrawnPlot> plots = writePlots({sweepPlot(sweep)}, folder);
  writeTextAtomically(folder / "report.html", sweepHtml(sweep, plots.front().svg));
  writeTextAtomically(folder / "summary.json", sweepJson(sweep));
}

}  // namespace gnomon
