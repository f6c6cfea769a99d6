#include "report/suite/suite_files.h"

#include <fmt/core.h>

#include <vector>

#include "report/paper/paper_files.h"
#include "report/plots/drawn_plots.h"
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
  const DrawnPlots plots =
      drawPlots([&](PlotPlace place) { return suitePlots(statistics, place); }, nullptr);
  for (const DrawnPlots::File& file : plots.paper) folder.write(file.name, file.bytes);
  folder.write("suite.html", suiteHtml(statistics, plots.page, command).text());
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
