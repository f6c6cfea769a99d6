#include "report/suite/suite_files.h"

#include <fmt/core.h>

#include <utility>
#include <vector>

#include "report/paper/paper_files.h"
#include "report/plotted_methods.h"
#include "report/suite/suite_html.h"
#include "report/suite/suite_json.h"
#include "report/suite/suite_plots.h"
#include "report/suite/suite_tables.h"
#include "report/tables/formats/csv_format.h"
#include "report/tables/formats/markdown_format.h"

namespace gnomon::report {
namespace {

void writeTables(const study::SuiteStatistics& statistics,
                 std::span<const study::StudyMeans> studies, RunFolder& folder) {
  folder.write("suite.csv", csvTable(suiteResultsTable(statistics, studies)));
  folder.write("suite.md", markdownTable(suiteRankedTable(statistics)));
}

}  // namespace

void writeSuiteFiles(const study::SuiteStatistics& statistics,
                     std::span<const study::StudyMeans> studies, std::string_view command,
                     const PaperOptions& paper, RunFolder& folder) {
  writeTables(statistics, studies, folder);
  writePaperFiles(statistics, paper, folder);
  std::vector<PlotSheet> sheets = sheetsOf(suitePlots(statistics, plottedMethods(statistics)));
  const bool isRanked = !statistics.methods.empty() && statistics.methods.front().rank;
  if (isRanked) sheets.push_back(suiteWinsPlot(statistics));
  const std::vector<DrawnPlot> plots = drawPlots(std::move(sheets), nullptr);
  for (const DrawnPlot& plot : plots) {
    folder.write(fmt::format("plots/{}.svg", plot.sheet.name), plot.svg);
    folder.write(fmt::format("plots/{}.pdf", plot.sheet.name), plot.pdf);
  }
  folder.write("suite.html", suiteHtml(statistics, plots, command).text());
}

bool writeSuiteOf(std::span<const study::StudyMeans> studies, std::string_view command,
                  SuiteParts parts, const PaperOptions& paper, RunFolder& folder) {
  const std::string suite = study::suiteOf(studies);
  if (suite.empty()) return false;
  study::SuiteStatistics statistics = study::suiteStatistics(suite, studies);
  if (parts == SuiteParts::all) {
    writeSuiteFiles(statistics, studies, command, paper, folder);
  } else {
    for (study::SuiteScene& scene : statistics.scenes) scene.report.clear();
    writeTables(statistics, studies, folder);
  }
  folder.write("suite.json", suiteJson(statistics, command));
  return true;
}

}  // namespace gnomon::report
