#include "report/run_files.h"

#include <array>
#include <string>
#include <vector>

#include "common/atomic_file.h"
#include "common/parallel.h"
#include "report/bin_files.h"
#include "report/budget_files.h"
#include "report/frontier.h"
#include "report/gnuplot.h"
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

/// Fonts are the one thing that it does not hold: they are the system's, and change no figure.
ContentKey keyOf(const PlotSheet& sheet, std::string_view format) {
  KeyBuilder key("plot");
  key.add("format", format).add("gnuplot", gnuplotVersion()).add("title", sheet.title);
  key.add("width", sheet.width).add("height", sheet.height);
  return key.add("commands", sheet.commands).key();
}

/// Draws all plots in both formats, as many at a time as there are cores, and writes them.
std::vector<DrawnPlot> writePlots(std::vector<PlotSheet> sheets, const fs::path& folder,
                                  Cache& cache) {
  std::vector<DrawnPlot> plots(sheets.size());
  std::vector<std::string> pdfs(sheets.size());
  parallelFor(0, 2 * sheets.size(), [&](std::size_t i) {
    const PlotSheet& sheet = sheets[i / 2];
    if (i % 2 == 0) {
      plots[i / 2].svg = cache.remember(keyOf(sheet, "svg"), [&] { return svgOf(sheet); });
    } else {
      pdfs[i / 2] = cache.remember(keyOf(sheet, "pdf"), [&] { return pdfOf(sheet); });
    }
  });
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    writeTextAtomically(folder / plotFolder / (sheets[i].name + ".svg"), plots[i].svg);
    writeTextAtomically(folder / plotFolder / (sheets[i].name + ".pdf"), pdfs[i]);
    plots[i].sheet = std::move(sheets[i]);
  }
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

void writeRunFiles(const StudyRecord& record, const fs::path& folder, Cache& cache) {
  writeTextAtomically(folder / "metrics.csv", metricsCsv(record));
  writeTextAtomically(folder / "table.csv", tableCsv(record));
  writeTextAtomically(folder / "table.tex", tableTex(record));
  if (!record.bins.empty()) writeTextAtomically(folder / "bins.csv", binsCsv(record));
  const std::vector<FrontierPoint> points = frontier(record);
  if (!points.empty()) writeTextAtomically(folder / "frontier.csv", frontierCsv(points));
  if (!record.budgets.empty()) writeTextAtomically(folder / "budget.csv", budgetCsv(record));
  const std::vector<DrawnPlot> plots = writePlots(studyPlots(record), folder, cache);
  writeTextAtomically(folder / "report.html", reportHtml(record, folder, plots, cache));
  writeTextAtomically(folder / "summary.json", summaryJson(record));
}

void writeSweepFiles(const SweepRecord& sweep, const fs::path& folder, Cache& cache) {
  writeTextAtomically(folder / "sweep.csv", sweepCsv(sweep));
  const std::vector<DrawnPlot> plots = writePlots({sweepPlot(sweep)}, folder, cache);
  writeTextAtomically(folder / "report.html", sweepHtml(sweep, plots.front().svg));
  writeTextAtomically(folder / "summary.json", sweepJson(sweep));
}

}  // namespace gnomon
