#include "report/plots/sweep_lights_plot.h"

#include <fmt/core.h>

#include <algorithm>
#include <vector>

#include "common/lists.h"
#include "report/plots/gnuplot.h"
#include "report/plots/panel_grid.h"
#include "report/plots/plot_style.h"
#include "report/text/number_text.h"
#include "study/judge/distinguish.h"
#include "study/judge/study_means.h"
#include "study/record/cases.h"

namespace gnomon::report {
namespace {

/// The lights and the methods of a slice, each once, in the order of the records.
struct Curves {
  std::vector<std::string> lights, methods;
};

Curves curvesOf(const study::SweepRecord& sweep, const SweepSlice& slice) {
  Curves curves;
  std::vector<std::size_t> order = slice.cases;
  std::sort(order.begin(), order.end());
  for (const std::size_t i : order) {
    for (const study::Case& which : study::comparedCases(sweep.steps[i])) {
      appendOnce(curves.lights, which.light);
    }
    for (const std::string& method : study::methodsOf(sweep.steps[i])) {
      appendOnce(curves.methods, method);
    }
  }
  return curves;
}

/// Whether a light is at more than one value: those that the sweep itself changes are not.
bool recurs(const study::SweepRecord& sweep, const SweepSlice& slice, const std::string& light) {
  return std::count_if(slice.cases.begin(), slice.cases.end(), [&](std::size_t i) {
           const std::vector<study::Case> cases = study::comparedCases(sweep.steps[i]);
           return std::any_of(cases.begin(), cases.end(),
                              [&](const study::Case& which) { return which.light == light; });
         }) > 1;
}

/// A method's error rate under one light, mean over the views that have it; of the interval the
/// mean of its ends. None where a view has none.
struct LightMean {
  std::optional<double> error;
  std::optional<compare::Interval> interval;
};

LightMean meanUnder(const study::StudyRecord& step, const std::string& method,
                    const std::string& light) {
  std::vector<std::optional<double>> errors, lows, highs;
  for (const study::Case& which : study::comparedCases(step)) {
    if (which.light != light) continue;
    const auto error =
        study::rateOf(step, method, which, study::Answer::drawn, compare::metrics::errorRate);
    if (!error) continue;
    errors.push_back(error);
    const auto found = study::findConfidence(step, which.view, light, method);
    const auto interval = found ? found->interval : std::nullopt;
    lows.push_back(interval ? std::optional(interval->low) : std::nullopt);
    highs.push_back(interval ? std::optional(interval->high) : std::nullopt);
  }
  const auto low = study::meanOf(lows);
  const auto high = study::meanOf(highs);
  return {study::meanOf(errors),
          low && high ? std::optional(compare::Interval{*low, *high}) : std::nullopt};
}

/// One curve's rows, and those of its bars.
struct CurveData {
  std::string line, bars;
};

CurveData dataOf(const study::SweepRecord& sweep, const SweepSlice& slice,
                 const std::string& method, const std::string& light) {
  CurveData data;
  for (std::size_t i = 0; i < slice.cases.size(); ++i) {
    const LightMean mean = meanUnder(sweep.steps[slice.cases[i]], method, light);
    const std::string place = exactText(slice.positions[i]);
    if (!mean.error) {
      data.line += place + " NaN\n";
      continue;
    }
    const std::string error = exactText(100 * *mean.error);
    data.line += fmt::format("{} {}\n", place, error);
    if (!mean.interval) continue;
    data.bars += fmt::format("{} {} {}\n", place, exactText(100 * mean.interval->low),
                             exactText(100 * mean.interval->high));
  }
  return data;
}

/// The truth's uncertainty at each value, the largest over views and lights.
std::string bandData(const study::SweepRecord& sweep, const SweepSlice& slice) {
  std::string rows;
  for (std::size_t i = 0; i < slice.cases.size(); ++i) {
    const auto largest = study::largestUncertainty(study::studyMeans(sweep.steps[slice.cases[i]]));
    rows += fmt::format("{} {}\n", exactText(slice.positions[i]),
                        largest ? exactText(100 * *largest) : "NaN");
  }
  return rows;
}

/// The plot of one method: its data, then the command.
std::string panelCommands(const study::SweepRecord& sweep, const SweepSlice& slice,
                          const Curves& curves, std::size_t m, PlotSheet& sheet) {
  std::string data;
  std::string lines = "plot " + plotBand("$truth", false);
  std::string bars;
  ValuePoints values(fmt::format("$v{}l", m));
  for (std::size_t l = 0; l < curves.lights.size(); ++l) {
    const CurveData curve = dataOf(sweep, slice, curves.methods[m], curves.lights[l]);
    data += fmt::format("$m{}l{} << EOD\n{}EOD\n", m, l, curve.line);
    lines += fmt::format(", \\\n  $m{}l{} using 1:2 with linespoints {} title {}", m, l,
                         lightLine(l), plotLegend(curves.lights[l]));
    for (std::size_t i = 0; i < slice.cases.size(); ++i) {
      const auto error =
          meanUnder(sweep.steps[slice.cases[i]], curves.methods[m], curves.lights[l]).error;
      if (!error) continue;
      values.add(sheet, slice.positions[i], 100 * *error,
                 fmt::format("{}, {}: {} % wrong, {}", curves.methods[m], curves.lights[l],
                             percentText(error), valueText(slice, i)));
    }
    values.endCurve();
    if (curve.bars.empty()) continue;
    data += fmt::format("$b{}l{} << EOD\n{}EOD\n", m, l, curve.bars);
    bars += fmt::format(", \\\n  $b{}l{} {}", m, l, plotBars(lightColour(l), "0.015"));
  }
  return data + values.data(sheet) + fmt::format("set title {}\n", plotLegend(curves.methods[m])) +
         lines + bars + values.plot(sheet) + "\n";
}

/// The errors behind the plot: a row a method and light, a column a value.
Table valuesTable(const study::SweepRecord& sweep, const SweepSlice& slice, const Curves& curves) {
  Table table{.kind = "values",
              .columns = {{"Method", "", Quantity::name}, {"Light", "", Quantity::text}}};
  for (std::size_t i = 0; i < slice.cases.size(); ++i) {
    table.columns.push_back({placeText(slice, i), "", Quantity::percent});
  }
  for (const std::string& method : curves.methods) {
    for (const std::string& light : curves.lights) {
      Row row{{textCell(method), textCell(light)}};
      for (const std::size_t i : slice.cases) {
        row.cells.push_back(valueCell(meanUnder(sweep.steps[i], method, light).error));
      }
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

}  // namespace

std::optional<PlotSheet> sweepLightsPlot(const study::SweepRecord& sweep, const SweepSlice& slice,
                                         PlotPlace place) {
  const Curves curves = curvesOf(sweep, slice);
  if (curves.lights.size() < 2 || curves.lights.size() > mostPlottedLights) return std::nullopt;
  if (std::none_of(curves.lights.begin(), curves.lights.end(),
                   [&](const std::string& light) { return recurs(sweep, slice, light); })) {
    return std::nullopt;
  }
  const bool isPaper = place == PlotPlace::paper;
  const PanelGrid grid(curves.methods.size(), isPaper ? curves.lights : std::vector<std::string>(),
                       place);
  PlotSheet sheet{.name = "sweep_lights" + slice.suffix,
                  .title = fmt::format("{}, by light{}", sweep.heading(),
                                       slice.title.empty() ? "" : ", " + slice.title),
                  .about = "Error rate of each method under each light against " + slice.axis,
                  .width = grid.width(),
                  .height = grid.height(),
                  .place = place,
                  .table = valuesTable(sweep, slice, curves)};
  for (std::size_t l = 0; l < curves.lights.size(); ++l) {
    sheet.legend.push_back({.text = curves.lights[l],
                            .variable = lightColour(l),
                            .point = lightPoints.at(l % lightPoints.size()),
                            .dash = static_cast<int>(1 + l / lightPoints.size())});
  }
  sheet.legend.push_back(bandItem());
  sheet.commands = plotData("$truth", bandData(sweep, slice)) + grid.opening(slice.axis) +
                   (isPaper ? "" : "unset key\n") +
                   "set yrange [0:*]\n"
                   "set offsets graph 0.03, graph 0.03, graph 0.05, 0\n" +
                   axisCommands(slice);
  for (std::size_t m = 0; m < curves.methods.size(); ++m) {
    sheet.commands += grid.panel(m) + panelCommands(sweep, slice, curves, m, sheet);
  }
  sheet.commands += "unset multiplot\n";
  return sheet;
}

}  // namespace gnomon::report
