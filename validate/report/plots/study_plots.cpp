#include "report/plots/study_plots.h"

#include "report/plots/bin_plot.h"
#include "report/plots/budget_plot.h"
#include "report/plots/frontier.h"
#include "study/spec/file_names.h"

namespace gnomon {
namespace {

void addBins(std::vector<PlotSheet>& plots, const StudyRecord& record) {
  for (const std::string& axis : binAxes(record)) {
    const std::vector<std::string> views = binViews(record, axis);
    const std::vector<std::string> files = fileNames(views);
    for (std::size_t i = 0; i < views.size(); ++i) {
      plots.push_back(binPlot(record, axis, views[i]));
      plots.back().name += "_" + files[i];
    }
  }
}

/// The budgets of all lights together.
void addBudget(std::vector<PlotSheet>& plots, const StudyRecord& record) {
  std::vector<BudgetRecord> budgets;
  for (const BudgetRecord& budget : record.budgets) {
    if (budget.light == record.budgets.front().light) budgets.push_back(budget);
  }
  if (!budgets.empty()) plots.push_back(budgetPlot(budgets));
}

}  // namespace

std::vector<PlotSheet> studyPlots(const StudyRecord& record) {
  std::vector<PlotSheet> plots;
  addBins(plots, record);
  const std::vector<FrontierPoint> points = frontier(record);
  if (!points.empty()) plots.push_back(frontierPlot(points));
  addBudget(plots, record);
  return plots;
}

}  // namespace gnomon
