#include "report/plots/sweep_plots.h"

#include <utility>

#include "report/plots/sweep_cost_plots.h"
#include "report/plots/sweep_lights_plot.h"
#include "report/plots/sweep_map_plot.h"
#include "report/plots/sweep_plot.h"
#include "report/plots/sweep_slices.h"

namespace gnomon::report {

std::vector<PlotSheet> sweepPlots(const study::SweepRecord& sweep, PlotPlace place) {
  std::vector<PlotSheet> sheets;
  const auto add = [&](PlotSheet sheet, const char* section) {
    sheet.section = section;
    sheets.push_back(std::move(sheet));
  };
  const std::vector<SweepSlice> slices = slicesOf(sweep);
  for (const SweepSlice& slice : slices) {
    add(sweepPlot(sweep, slice, place), sweepErrorSection);
    if (auto lights = sweepLightsPlot(sweep, slice, place)) {
      lights->isForPaper = false;
      add(std::move(*lights), sweepLightsSection);
    }
  }
  if (isGrid(sweep)) {
    add(sweepMapPlot(sweep, place), sweepErrorSection);
    sheets.back().isForPaper = false;
  }
  if (slices.size() == 1) {
    for (PlotSheet& sheet : sweepCostPlots(sweep, slices.front(), place)) {
      add(std::move(sheet), sweepCostSection);
    }
  }
  return sheets;
}

}  // namespace gnomon::report
