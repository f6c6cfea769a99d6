#include "report/plots/study_plots.h"

#include "report/plots/bin_plot.h"
#include "report/plots/budget_plot.h"
#include "report/plots/frontier_plot.h"
#include "report/text/budget_text.h"
#include "study/spec/file_names.h"

namespace gnomon::report {
namespace {

void addBins(std::vector<PlotSheet>& plots, const study::StudyRecord& record,
             const MethodStyles& styles, PlotPlace place) {
  for (const std::string& axis : binAxes(record)) {
    const std::vector<std::string> views = binViews(record, axis);
    const std::vector<std::string> files = study::fileNames(views);
    for (std::size_t i = 0; i < views.size(); ++i) {
      plots.push_back(binPlot(record, axis, views[i], styles, place));
      plots.back().name += "_" + files[i];
    }
  }
}

/// A plot for all lights together, then one for each of several.
void addBudgets(std::vector<PlotSheet>& plots, const study::StudyRecord& record, PlotPlace place) {
  const std::vector<std::string> lights = budgetLights(record);
  const std::vector<std::string> files = study::fileNames(lights);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    plots.push_back(budgetPlot(budgetsOf(record, lights[i]), place, study::isSoft(record)));
    if (i > 0) plots.back().name += "_" + files[i];
  }
}

}  // namespace

std::vector<PlotSheet> studyPlots(const study::StudyRecord& record, PlotPlace place) {
  std::vector<PlotSheet> plots;
  const study::StudyMeans means = study::studyMeans(record);
  const MethodStyles styles(means);
  addBins(plots, record, styles, place);
  for (const Price price : {Price::memory, Price::frameTime, Price::texels}) {
    const std::vector<FrontierPoint> points = frontier(record, price);
    if (!points.empty())
      plots.push_back(frontierPlot(points, price, styles, study::largestUncertainty(means), place,
                                   means.isSoft));
  }
  addBudgets(plots, record, place);
  return plots;
}

}  // namespace gnomon::report
