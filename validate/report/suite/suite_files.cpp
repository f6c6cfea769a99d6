#include "report/suite/suite_files.h"

#include <fmt/core.h>

#include <vector>

#include "common/parallel.h"
#include "report/paper/paper_files.h"
#include "report/suite/suite_html.h"
#include "report/suite/suite_json.h"
#include "report/suite/suite_plots.h"
#include "report/suite/suite_tables.h"
#include "report/tables/formats/csv_format.h"
#include "report/tables/formats/markdown_format.h"

namespace gnomon::report {
namespace {

std::vector<DrawnPlot> writeSuitePlots(const study::SuiteStatistics& statistics,
                                       RunFolder& folder) {
  const std::vector<PlotSheet> paper = suitePlots(statistics);
  const std::vector<PlotSheet> wide = suitePlots(statistics, PlotPlace::page);
  const std::vector<PlotSheet> narrow = suitePlots(statistics, PlotPlace::phone);
  std::vector<DrawnPlot> plots(wide.size());
  parallelFor(0, wide.size(), [&](std::size_t i) {
    plots[i] = {wide[i], svgOf(wide[i])};
    if (narrow[i].width == wide[i].width) return;
    plots[i].narrow = narrow[i];
    plots[i].narrowSvg = svgOf(narrow[i]);
  });
  const std::vector<std::string> pdfs = pdfsOf(paper);
  for (std::size_t i = 0; i < paper.size(); ++i) {
    folder.write(fmt::format("plots/{}.svg", paper[i].name), svgOf(paper[i]));
    folder.write(fmt::format("plots/{}.pdf", paper[i].name), pdfs[i]);
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
                     const PaperOptions& paper, RunFolder& folder) {
  writeTables(statistics, studies, folder);
  writePaperFiles(statistics, paper, folder);
  const std::vector<DrawnPlot> plots = writeSuitePlots(statistics, folder);
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
