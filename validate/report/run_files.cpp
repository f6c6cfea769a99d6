#include "report/run_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/parallel.h"
#include "report/json/summary_json.h"
#include "report/json/sweep_json.h"
#include "report/page/report_html.h"
#include "report/page/sweep_html.h"
#include "report/paper/paper_files.h"
#include "report/plots/gnuplot.h"
#include "report/plots/study_plots.h"
#include "report/plots/sweep_plots.h"
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

/// Fonts are the one thing that it does not hold: they are the system's, and change no figure.
cache::ContentKey keyOf(const PlotSheet& sheet, std::string_view format) {
  cache::KeyBuilder key("plot");
  key.add("format", format).add("gnuplot", gnuplotVersion()).add("title", sheet.title);
  key.add("width", sheet.width).add("height", sheet.height);
  key.add("place", static_cast<int>(sheet.place)).add("shaded", sheet.isShaded ? 1 : 0);
  for (const PlotColour& colour : sheet.colours) key.add(colour.variable, colour.onWhite);
  return key.add("commands", sheet.commands).key();
}

/// One plot in one format.
struct PlotFile {
  const PlotSheet* sheet;
  cache::ContentKey key;
  std::string bytes = {};
};

struct PlotFormat {
  std::string_view name;
  std::vector<std::string> (*write)(const std::vector<PlotSheet>&);
  std::size_t plotsAtOnce;
};

constexpr std::array<PlotFormat, 2> plotFormats = {{
    {"svg", [](const auto& sheets) { return std::vector{svgOf(sheets.front())}; }, 1},
    // So few that other cores have some, so many that most are spared a start.
    {"pdf", pdfsOf, 8},
}};

/// Draws some of the files, and keeps them.
void draw(std::span<PlotFile* const> wanted, const PlotFormat& format, cache::Cache& cache) {
  std::vector<PlotSheet> sheets;
  for (const PlotFile* file : wanted) sheets.push_back(*file->sheet);
  std::vector<std::string> drawn = format.write(sheets);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    wanted[i]->bytes = std::move(drawn[i]);
    cache.keep(wanted[i]->key, wanted[i]->bytes);
  }
}

/// The plots in one format, drawn where the cache does not have them.
std::vector<PlotFile> plotFiles(const std::vector<PlotSheet>& sheets, const PlotFormat& format,
                                cache::Cache& cache) {
  std::vector<PlotFile> all;
  all.reserve(sheets.size());
  for (const PlotSheet& sheet : sheets) all.push_back({&sheet, keyOf(sheet, format.name)});
  std::vector<PlotFile*> missing;
  for (PlotFile& file : all) {
    auto kept = cache.find<std::string>(file.key);
    if (kept) file.bytes = std::move(*kept);
    if (!kept) missing.push_back(&file);
  }
  const std::size_t parts = (missing.size() + format.plotsAtOnce - 1) / format.plotsAtOnce;
  parallelFor(0, parts, [&](std::size_t part) {
    const auto rest = std::span(missing).subspan(part * format.plotsAtOnce);
    draw(rest.first(std::min(format.plotsAtOnce, rest.size())), format, cache);
  });
  return all;
}

/// Draws all plots, in both formats for paper and as SVG for the page, and writes the former.
/// @param sheetsFor  all plots as a place has them
template <typename SheetsFor>
std::vector<DrawnPlot> writePlots(const SheetsFor& sheetsFor, RunFolder& folder,
                                  cache::Cache& cache) {
  std::vector<PlotSheet> paper = sheetsFor(PlotPlace::paper);
  std::vector<PlotSheet> wide = sheetsFor(PlotPlace::page);
  std::vector<PlotSheet> narrow = sheetsFor(PlotPlace::phone);
  const PlotFormat& svg = plotFormats.at(0);
  const PlotFormat& pdf = plotFormats.at(1);
  std::array<std::vector<PlotFile>, 4> drawn;
  parallelFor(0, drawn.size(), [&](std::size_t i) {
    const std::vector<PlotSheet>& sheets = i < 2 ? paper : i == 2 ? wide : narrow;
    drawn.at(i) = plotFiles(sheets, i == 1 ? pdf : svg, cache);
  });
  for (std::size_t i = 0; i < 2; ++i) {
    for (const PlotFile& file : drawn.at(i)) {
      folder.write(fmt::format("plots/{}.{}", file.sheet->name, plotFormats.at(i).name),
                   file.bytes);
    }
  }
  std::vector<DrawnPlot> plots(wide.size());
  for (std::size_t i = 0; i < wide.size(); ++i) {
    plots[i].svg = std::move(drawn.at(2)[i].bytes);
    plots[i].sheet = std::move(wide[i]);
    // One that is as wide on a phone scrolls sideways there.
    if (narrow[i].width == plots[i].sheet.width) continue;
    plots[i].narrowSvg = std::move(drawn.at(3)[i].bytes);
    plots[i].narrow = std::move(narrow[i]);
  }
  return plots;
}

}  // namespace

void writeRunFiles(const study::StudyRecord& record, const PaperOptions& paper, RunFolder& folder,
                   cache::Cache& cache) {
  folder.removeIndex();
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
      writePlots([&](PlotPlace place) { return studyPlots(record, place); }, folder, cache);
  folder.write("report.html", reportHtml(record, folder.path(), plots).text());
  folder.finish(summaryJson(record));
}

void writeSweepFiles(const study::SweepRecord& sweep, const PaperOptions& paper, RunFolder& folder,
                     cache::Cache& cache) {
  folder.removeIndex();
  folder.write("sweep.csv", csvTable(sweepMeansTable(sweep)));
  folder.write("cases.csv", longCsv(sweep));
  writePaperFiles(sweep, paper, folder);
  const std::vector<DrawnPlot> plots =
      writePlots([&](PlotPlace place) { return sweepPlots(sweep, place); }, folder, cache);
  folder.write("report.html", sweepHtml(sweep, plots).text());
  folder.finish(sweepJson(sweep));
}

}  // namespace gnomon::report
