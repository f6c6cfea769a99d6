#include "report/suite/suite_files.h"

#include <fmt/core.h>

#include <vector>

#include "common/parallel.h"
#include "report/suite/suite_html.h"
#include "report/suite/suite_json.h"
#include "report/suite/suite_plots.h"
#include "report/suite/suite_tables.h"
#include "report/tables/formats/csv_format.h"
#include "report/tables/formats/markdown_format.h"

namespace gnomon::report {
namespace {

std::vector<DrawnPlot> writePlots(const std::vector<PlotSheet>& sheets, RunFolder& folder) {
  std::vector<DrawnPlot> plots(sheets.size());
  parallelFor(0, sheets.size(), [&](std::size_t i) { plots[i] = {sheets[i], svgOf(sheets[i])}; });
  const std::vector<std::string> pdfs = pdfsOf(sheets);
  for (std::size_t i = 0; i < plots.size(); ++i) {
    folder.write(fmt::format("plots/{}.svg", sheets[i].name), plots[i].svg);
    folder.write(fmt::format("plots/{}.pdf", sheets[i].name), pdfs[i]);
  }
  return plots;
}

void writeTables(const study::SuiteStatistics& statistics,
                 std::span<const study::StudyMeans> studies, RunFolder& folder) {
  folder.write("suite.csv", csvTable(suiteResultsTable(statistics, studies)));
  folder.write("suite.md", markdownTable(suiteRankedTable(statistics)));
}

}  // namespace

void writeSuiteFiles(const study::SuiteStatistics& statistics,
                     std::span<const study::StudyMeans> studies, std::string_view command,
                     RunFolder& folder) {
  writeTables(statistics, studies, folder);
  const std::vector<DrawnPlot> plots = writePlots(suitePlots(statistics), folder);
  folder.write("suite.html", suiteHtml(statistics, plots, command).text());
}

bool writeSuiteOf(std::span<const study::StudyMeans> studies, std::string_view command,
                  SuiteParts parts, RunFolder& folder) {
  const std::string suite = study::suiteOf(studies);
  if (suite.empty()) return false;
  study::SuiteStatistics statistics = study::suiteStatistics(suite, studies);
  if (parts == SuiteParts::all) {
    writeSuiteFiles(statistics, studies, command, folder);
  } else {
    for (study::SuiteScene& scene : statistics.scenes) scene.report.clear();
    writeTables(statistics, studies, folder);
  }
  folder.write("suite.json", suiteJson(statistics, command));
  return true;
}

}  // namespace gnomon::report
