#include "report/plots/sweep_plot.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "report/plots/gnuplot.h"
#include "report/plots/method_styles.h"
#include "report/plots/plot_style.h"
#include "report/text/interval_text.h"
#include "report/text/number_text.h"
#include "study/judge/study_ranking.h"

namespace gnomon::report {
namespace {

using MeanFigure = std::optional<double> study::MethodMeans::*;

struct Panel {
  MeanFigure figure;
  const char* name;   ///< of its data, as a suffix
  const char* title;  ///< errorAxis in its place for the error rate
  const char* words;  ///< of one of its values: "0.39 % wrong"
};

constexpr int pageWidth = 1000;  // pixels

constexpr std::array<Panel, 3> sweepPanels = {{
    {&study::MethodMeans::errorRate, "e", "error rate", "wrong"},
    {&study::MethodMeans::falseShadow, "s", "false shadow, percent", "false shadow"},
    {&study::MethodMeans::falseLight, "l", "false light, percent", "false light"},
}};

/// A slice's figures in increasing order of its positions.
struct Series {
  std::vector<double> values;
  std::vector<study::StudyMeans> steps;
  std::vector<std::string> methods;  ///< as the steps list them
  std::vector<std::string> legends;  ///< one a method
};

/// In the slice alone: with how many cases it is over.
study::MethodMeans overSteps(const std::vector<study::StudyMeans>& steps,
                             const std::string& label) {
  study::MethodMeans all{label, label, {}, {}, {}, {}};
  for (const study::StudyMeans& step : steps) {
    const study::MethodMeans* means = study::findMeans(step, label);
    const std::vector<std::optional<double>> errors =
        means != nullptr ? means->caseErrors
                         : std::vector<std::optional<double>>(study::caseCount(step));
    all.caseErrors.insert(all.caseErrors.end(), errors.begin(), errors.end());
  }
  return all;
}

Series seriesOf(const study::SweepRecord& sweep, const SweepSlice& slice) {
  Series series;
  series.values = slice.positions;
  for (const std::size_t i : slice.cases)
    series.steps.push_back(study::studyMeans(sweep.steps.at(i)));
  std::vector<study::StudyMeans> unsorted;  // whose first lists the methods
  std::vector<std::size_t> order = slice.cases;
  std::sort(order.begin(), order.end());
  for (const std::size_t i : order) {
    const auto at = std::find(slice.cases.begin(), slice.cases.end(), i) - slice.cases.begin();
    unsorted.push_back(series.steps[static_cast<std::size_t>(at)]);
  }
  for (const std::string& label : study::labelsOf(unsorted)) {
    series.methods.push_back(label);
    series.legends.push_back(study::labelWithCases(overSteps(unsorted, label)));
  }
  return series;
}

std::string percentData(std::optional<double> share) {
  return share ? exactText(100 * *share) : "NaN";
}

std::string lineData(const Series& series, const std::string& method, MeanFigure figure) {
  std::string rows;
  for (std::size_t i = 0; i < series.values.size(); ++i) {
    const study::MethodMeans* means = study::findMeans(series.steps[i], method);
    rows += fmt::format("{} {}\n", exactText(series.values[i]),
                        percentData(means == nullptr ? std::nullopt : means->*figure));
  }
  return rows;
}

std::string bandData(const Series& series) {
  std::string rows;
  for (std::size_t i = 0; i < series.values.size(); ++i) {
    rows += fmt::format("{} {}\n", exactText(series.values[i]),
                        percentData(study::largestUncertainty(series.steps[i])));
  }
  return rows;
}

/// Value and the ends of the interval of its error rate; nothing of a value without one.
std::string intervalData(const Series& series, const std::string& method) {
  std::string rows;
  for (std::size_t i = 0; i < series.values.size(); ++i) {
    const study::MethodMeans* means = study::findMeans(series.steps[i], method);
    if (means == nullptr || !means->errorRate || !means->interval) continue;
    rows += fmt::format("{} {} {}\n", exactText(series.values[i]),
                        percentData(means->interval->low), percentData(means->interval->high));
  }
  return rows;
}

std::string dataBlocks(const Series& series) {
  std::string text = plotData("$truth", bandData(series));
  for (const Panel& panel : sweepPanels) {
    for (std::size_t m = 0; m < series.methods.size(); ++m) {
      text += plotData(fmt::format("${}{}", panel.name, m),
                       lineData(series, series.methods[m], panel.figure));
    }
  }
  for (std::size_t m = 0; m < series.methods.size(); ++m) {
    const std::string rows = intervalData(series, series.methods[m]);
    if (!rows.empty()) text += fmt::format("$i{} << EOD\n{}EOD\n", m, rows);
  }
  return text;
}

/// Indices of the methods from the highest line to the lowest at the largest value.
std::vector<std::size_t> legendOrder(const Series& series) {
  std::vector<double> depths;
  for (const std::string& method : series.methods) {
    const study::MethodMeans* means = study::findMeans(series.steps.back(), method);
    depths.push_back(means == nullptr ? 0 : -means->errorRate.value_or(0));
  }
  return risingOrder(depths);
}

std::vector<LegendEntry> legendOf(const Series& series) {
  std::vector<LegendEntry> legend;
  for (const std::size_t m : legendOrder(series)) {
    legend.push_back({series.methods[m], series.legends[m]});
  }
  return legend;
}

std::size_t indexOf(const Series& series, const std::string& method) {
  const auto found = std::find(series.methods.begin(), series.methods.end(), method);
  return static_cast<std::size_t>(found - series.methods.begin());
}

std::string plotCommand(const Series& series, const Panel& panel, const MethodStyles& styles) {
  std::string text = "plot " + plotBand("$truth", true);
  for (const std::string& method : styles.drawnOrder(series.methods)) {
    text += fmt::format(", \\\n  ${}{} using 1:2 with linespoints {} notitle", panel.name,
                        indexOf(series, method), styles.line(method));
  }
  // After the lines, so that no line hides a bar.
  for (std::size_t m = 0; m < series.methods.size(); ++m) {
    if (panel.figure != &study::MethodMeans::errorRate) break;
    if (intervalData(series, series.methods[m]).empty()) continue;
    text +=
        fmt::format(", \\\n  $i{} {}", m, plotBars(styles.variable(series.methods[m]), "0.006"));
  }
  text += styles.legend(legendOf(series), "linespoints", &MethodStyles::line);
  return text;
}

/// Where the legend beside the first panel begins, as a share of the page: so that its longest
/// label fits.
double legendLeft(const Series& series) {
  constexpr double symbol = 45;    // pixels
  constexpr double character = 8;  // likewise: wider than those of most fonts of 14 pixels
  std::size_t longest = displayWidth(bandLegend);
  for (const std::string& legend : series.legends) {
    longest = std::max(longest, std::min(longestLegend, displayWidth(legend)));
  }
  return 1 - (symbol + character * static_cast<double>(longest)) / pageWidth;
}

/// What a reader who points at the values of a panel is told.
ValuePoints valuesOf(const Series& series, const SweepSlice& slice, const Panel& panel,
                     const MethodStyles& styles, PlotSheet& sheet) {
  ValuePoints values(fmt::format("$v{}", panel.name));
  for (const std::string& method : styles.drawnOrder(series.methods)) {
    for (std::size_t i = 0; i < series.values.size(); ++i) {
      const study::MethodMeans* means = study::findMeans(series.steps[i], method);
      const auto figure = means == nullptr ? std::nullopt : means->*panel.figure;
      if (!figure) continue;
      const bool isError = panel.figure == &study::MethodMeans::errorRate;
      const std::string interval =
          isError && means->interval
              ? fmt::format(" (95 % interval {})", intervalText(means->interval))
              : "";
      values.add(sheet, series.values[i], 100 * *figure,
                 fmt::format("{}: {} % {}{}, {}", method, percentText(figure), panel.words,
                             interval, valueText(slice, i)));
    }
    values.endCurve();
  }
  return values;
}

/// The error rates behind the plot: a row a method, a column a value.
Table valuesTable(const Series& series, const SweepSlice& slice) {
  Table table{.kind = "values", .columns = {{"Method", "", Quantity::name}}};
  for (std::size_t i = 0; i < series.values.size(); ++i) {
    table.columns.push_back({placeText(slice, i), "", Quantity::percent});
  }
  for (std::size_t m = 0; m < series.methods.size(); ++m) {
    Row row{{textCell(series.legends[m])}};
    for (const study::StudyMeans& step : series.steps) {
      const study::MethodMeans* means = study::findMeans(step, series.methods[m]);
      row.cells.push_back(valueCell(means == nullptr ? std::nullopt : means->errorRate));
      if (means != nullptr && means->interval) {
        row.cells.back().about = "95 % interval " + intervalText(means->interval);
      }
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// So high that the first panel is as high as the legend beside it: gnuplot would put the rest into
/// a second column, off the page.
int paperHeight(const Series& series) {
  constexpr double lineHeight = 24;
  constexpr double share = 0.42;  // of the first panel
  const double lines = static_cast<double>(series.methods.size()) + 2;
  return std::max(820, static_cast<int>(lines * lineHeight / share));
}

/// Where a panel lies.
PlotMargins marginsOf(std::size_t panel, const Series& series, const PlotSheet& sheet) {
  const auto pixels = [](double share, int all) { return static_cast<int>(share * all); };
  if (sheet.place == PlotPlace::phone) {
    const int each = sheet.height / 3;
    const int above = static_cast<int>(panel) * each;
    return {46, 10, above + 28, sheet.height - above - each + 76};
  }
  const int width = sheet.width;
  const int height = sheet.height;
  const int split = pixels(0.53, height);
  if (panel == 0) {
    const double right = sheet.place == PlotPlace::paper ? legendLeft(series) - 0.025 : 0.985;
    return {pixels(0.07, width), width - pixels(right, width), pixels(0.05, height), split};
  }
  const int top = pixels(0.63, height);
  if (panel == 1) return {pixels(0.07, width), pixels(0.52, width), top, pixels(0.09, height)};
  return {pixels(0.57, width), pixels(0.015, width), top, pixels(0.09, height)};
}

}  // namespace

PlotSheet sweepPlot(const study::SweepRecord& sweep, const SweepSlice& slice, PlotPlace place) {
  const Series series = seriesOf(sweep, slice);
  const MethodStyles styles(study::studyMeans(sweep));
  PlotSheet sheet{
      .name = "sweep" + slice.suffix,
      .title = slice.title.empty() ? sweep.heading()
                                   : fmt::format("{}, {}", sweep.heading(), slice.title),
      .about = "Error rate, false shadow and false light of each method against " + slice.axis,
      .width = pageWidth,
      .height = paperHeight(series),
      .colours = styles.colours(),
      .place = place,
      .legend = styles.items(legendOf(series), true),
      .table = valuesTable(series, slice)};
  if (place == PlotPlace::page) sheet.height = 760;
  if (place == PlotPlace::phone) {
    sheet.width = 380;
    sheet.height = 930;
  }
  sheet.legend.push_back(bandItem());
  std::string panels;
  std::string values;
  for (std::size_t i = 0; i < sweepPanels.size(); ++i) {
    const Panel& panel = sweepPanels.at(i);
    const ValuePoints points = valuesOf(series, slice, panel, styles, sheet);
    values += points.data(sheet);
    panels += plotMargins(marginsOf(i, series, sheet), sheet.width, sheet.height) + "set title " +
              gnuplotText(i == 0 ? errorAxis(study::isSoft(sweep)) : panel.title) + "\n" +
              plotCommand(series, panel, styles) + points.plot(sheet) +
              "\nunset key\nset xtics font ',10'\n";  // narrow from here on
  }
  sheet.commands =
      dataBlocks(series) + values + "set multiplot\n" + plotFrame(3, "ytics ") +
      fmt::format(
          "set title offset 0,-0.4\n"
          "set xlabel offset 0,0.4 {}\n"
          "set offsets graph 0.03, graph 0.03, graph 0.05, 0\n"
          "set yrange [0:*]\n",
          gnuplotText(slice.axis)) +
      (place == PlotPlace::paper
           ? fmt::format("set key at screen {:.3f}, screen 0.94 left top Left reverse samplen 2 "
                         "spacing 1.1 maxcols 1\n",
                         legendLeft(series))
           : std::string("unset key\nset xtics font ',11'\nset ytics font ',11'\n")) +
      axisCommands(slice) + panels + "unset multiplot\n";
  return sheet;
}

}  // namespace gnomon::report
