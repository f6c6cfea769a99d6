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

}  // namespace

void writeSuiteFiles(const study::SuiteStatistics& statistics,
                     std::span<const study::StudyMeans> studies, std::string_view command,
                     RunFolder& folder) {
  folder.write("suite.csv", csvTable(suiteResultsTable(statistics, studies)));
  folder.write("suite.md", markdownTable(suiteRankedTable(statistics)));
  const std::vector<DrawnPlot> plots = writePlots(suitePlots(statistics), folder);
  folder.write("suite.html", suiteHtml(statistics, plots, command).text());
}

bool writeSuiteOf(std::span<const study::StudyMeans> studies, std::string_view command,
                  RunFolder& folder) {
  const std::string suite = study::suiteOf(studies);
  if (suite.empty()) return false;
  const study::SuiteStatistics statistics = study::suiteStatistics(suite, studies);
  writeSuiteFiles(statistics, studies, command, folder);
  folder.write("suite.json", suiteJson(statistics, command));
  return true;
}

}  // namespace gnomon::report
