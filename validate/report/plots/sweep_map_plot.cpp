#include "report/plots/sweep_map_plot.h"

#include <fmt/core.h>

#include <algorithm>

#include "report/plots/gnuplot.h"
#include "report/plots/panel_grid.h"
#include "report/plots/plot_style.h"
#include "report/plots/sweep_slices.h"
#include "report/text/number_text.h"
#include "study/judge/study_means.h"

namespace gnomon::report {

PlotSheet sweepMapPlot(const study::SweepRecord& sweep, PlotPlace place) {
  const SweepGrid grid = gridOf(sweep);
  std::vector<study::StudyMeans> steps;
  for (const study::StudyRecord& step : sweep.steps) steps.push_back(study::studyMeans(step));
  const std::vector<std::string> labels = study::labelsOf(steps);
  double worst = 0;
  std::string data;
  std::string plots;
  const PanelGrid panels(labels.size(), {"100.00"}, PlotPlace::page);
  for (std::size_t m = 0; m < labels.size(); ++m) {
    data += fmt::format("$m{} << EOD\n", m);
    for (std::size_t at = 0; at < grid.cases.size(); ++at) {
      const study::MethodMeans* means = study::findMeans(steps[grid.cases[at]], labels[m]);
      const auto error = means != nullptr ? means->errorRate : std::nullopt;
      worst = std::max(worst, error.value_or(0));
      data += fmt::format("{} {} {}\n", at % grid.across.size(), at / grid.across.size(),
                          error ? exactText(100 * *error) : "NaN");
    }
    data += "EOD\n";
    plots += panels.panel(m) +
             fmt::format("set title {}\nplot $m{} using 1:2:3 with image pixels notitle\n",
                         plotLegend(labels[m]), m);
    if (m == 0) plots += "unset colorbox\n";
  }
  std::string text =
      data + panels.opening(fmt::format("{} (across) and {} (up)", grid.acrossAxis, grid.upAxis)) +
      categoryTics("xtics", grid.across) + categoryTics("ytics", grid.up) +
      fmt::format("unset grid\nset cbrange [0:{}]\n", exactText(100 * (worst > 0 ? worst : 1))) +
      fmt::format("set xrange [-0.5:{}]\nset yrange [-0.5:{}]\n",
                  static_cast<double>(grid.across.size()) - 0.5,
                  static_cast<double>(grid.up.size()) - 0.5) +
      // From white over blue to black: also in print without colours.
      "set palette defined (0 '#ffffff', 0.25 '#9ecae1', 0.6 '#2171b5', 1 '#08142c')\n"
      "set colorbox user origin screen 0.945, screen 0.2 size screen 0.014, screen 0.6\n"
      "set cbtics font ',10'\n" +
      plots + "unset multiplot\n";
  return {"sweep_map",
          fmt::format("{}: error rate, percent", sweep.heading()),
          fmt::format("Error rate of each method over {} and {}", grid.acrossAxis, grid.upAxis),
          panels.width(),
          panels.height(),
          std::move(text),
          "plots",
          {},
          place,
          {},
          {},
          {},
          true};
}

}  // namespace gnomon::report
