#include "report/plots/sweep_plot.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "report/plots/gnuplot.h"
#include "report/plots/method_styles.h"
#include "report/plots/plot_style.h"
#include "report/text/number_text.h"
#include "study/judge/study_ranking.h"

namespace gnomon::report {
namespace {

using MeanFigure = std::optional<double> study::MethodMeans::*;

struct Panel {
  MeanFigure figure;
  const char* name;  ///< of its data, as a suffix
  const char* title;
  /// As shares of the page: left, right, bottom, top. The first panel ends where its legend begins.
  std::array<double, 4> margins;
};

constexpr int pageWidth = 1000;  // pixels
constexpr const char* truthLegend = "uncertainty of the truth";

constexpr std::array<Panel, 3> sweepPanels = {{
    {&study::MethodMeans::errorRate,
     "e",
     "error rate, percent of the samples",
     {0.09, 0, 0.53, 0.95}},
    {&study::MethodMeans::falseShadow, "s", "false shadow, percent", {0.09, 0.49, 0.09, 0.37}},
    {&study::MethodMeans::falseLight, "l", "false light, percent", {0.58, 0.98, 0.09, 0.37}},
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

std::size_t indexOf(const Series& series, const std::string& method) {
  const auto found = std::find(series.methods.begin(), series.methods.end(), method);
  return static_cast<std::size_t>(found - series.methods.begin());
}

std::string plotCommand(const Series& series, const Panel& panel, const MethodStyles& styles) {
  std::string text = fmt::format(
      "plot $truth using 1:2 with filledcurves y1=0 fc rgb band title '{}'", truthLegend);
  for (const std::string& method : styles.drawnOrder(series.methods)) {
    text += fmt::format(", \\\n  ${}{} using 1:2 with linespoints {} notitle", panel.name,
                        indexOf(series, method), styles.line(method));
  }
  // After the lines, so that no line hides a bar.
  for (std::size_t m = 0; m < series.methods.size(); ++m) {
    if (panel.figure != &study::MethodMeans::errorRate) break;
    if (intervalData(series, series.methods[m]).empty()) continue;
    text += fmt::format(", \\\n  $i{} {}", m, styles.bars(series.methods[m], "0.006"));
  }
  std::vector<LegendEntry> legend;
  for (const std::size_t m : legendOrder(series)) {
    legend.push_back({series.methods[m], series.legends[m]});
  }
  text += styles.legend(legend, "linespoints", &MethodStyles::line);
  return text + "\n";
}

/// Where the legend beside the first panel begins, as a share of the page: so that its longest
/// label fits.
double legendLeft(const Series& series) {
  constexpr double symbol = 45;    // pixels
  constexpr double character = 8;  // likewise: wider than those of most fonts of 14 pixels
  std::size_t longest = displayWidth(truthLegend);
  for (const std::string& legend : series.legends) {
    longest = std::max(longest, std::min(longestLegend, displayWidth(legend)));
  }
  return 1 - (symbol + character * static_cast<double>(longest)) / pageWidth;
}

std::string panelCommands(const Series& series, const Panel& panel, const MethodStyles& styles) {
  std::string text;
  constexpr std::array sides = {"lmargin", "rmargin", "bmargin", "tmargin"};
  for (std::size_t i = 0; i < sides.size(); ++i) {
    text += fmt::format("set {} at screen {}\n", sides.at(i), panel.margins.at(i));
  }
  return text + "set title " + gnuplotText(panel.title) + "\n" + plotCommand(series, panel, styles);
}

/// So high that the first panel is as high as the legend beside it: gnuplot would put the rest into
/// a second column, off the page.
int pageHeight(const Series& series) {
  constexpr double lineHeight = 24;
  const double share = sweepPanels[0].margins[3] - sweepPanels[0].margins[2];
  const double lines = static_cast<double>(series.methods.size()) + 2;
  return std::max(820, static_cast<int>(lines * lineHeight / share));
}

}  // namespace

PlotSheet sweepPlot(const study::SweepRecord& sweep, const SweepSlice& slice) {
  const Series series = seriesOf(sweep, slice);
  const MethodStyles styles(study::studyMeans(sweep));
  std::string text =
      dataBlocks(series) + "set multiplot\n" + plotFrame(3, "ytics ") +
      fmt::format(
          "set title offset 0,-0.4\n"
          "set xlabel offset 0,0.4 {}\n"
          "set offsets graph 0.03, graph 0.03, graph 0.05, 0\n"
          "set yrange [0:*]\n"
          "set key at screen {:.3f}, screen 0.94 left top Left reverse samplen 2 spacing 1.1 "
          "maxcols 1\n",
          gnuplotText(slice.axis), legendLeft(series));
  text += axisCommands(slice);
  for (Panel panel : sweepPanels) {
    if (panel.margins[1] == 0) panel.margins[1] = legendLeft(series) - 0.025;
    text += panelCommands(series, panel, styles);
    text += "unset key\nset xtics font ',10'\n";  // half as wide from here on
  }
  return {
      "sweep" + slice.suffix,
      slice.title.empty() ? sweep.heading() : fmt::format("{}, {}", sweep.heading(), slice.title),
      "Error rate, false shadow and false light of each method against " + slice.axis,
      pageWidth,
      pageHeight(series),
      text + "unset multiplot\n",
      "plots",
      styles.colours()};
}

}  // namespace gnomon::report
