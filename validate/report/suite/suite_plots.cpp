#include "report/suite/suite_plots.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/lists.h"
#include "report/plots/gnuplot.h"
#include "report/suite/suite_tables.h"
#include "report/text/number_text.h"

namespace gnomon::report {
namespace {

/// The least error that a logarithmic axis shows, percent.
constexpr double leastShown = 0.01;

/// The mean uncertainty of the truth, the largest over the methods, percent; 0 where none was
/// measured.
double largestUncertainty(const study::SuiteStatistics& statistics) {
  double largest = 0;
  for (const study::SuiteMethod& method : statistics.methods) {
    largest = std::max(largest, 100 * method.uncertainty);
  }
  return largest;
}

// ---- the cumulative plot

std::vector<double> sortedErrors(const study::SuiteStatistics& statistics,
                                 const std::string& label) {
  const compare::SceneTable& table = statistics.table;
  const auto found = std::find(table.methods.begin(), table.methods.end(), label);
  std::vector<double> errors;
  for (const auto& error :
       table.errors.at(static_cast<std::size_t>(found - table.methods.begin()))) {
    if (error) errors.push_back(std::max(leastShown, 100 * *error));
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

LinePlot errorsPlot(const study::SuiteStatistics& statistics, const std::vector<std::string>& shown,
                    const MethodStyles& styles) {
  double left = 100;
  double right = leastShown;
  LinePlot plot{
      .name = "suite-errors",
      .title = "Share of the scenes with an error below",
      .about = "Share of the scenes with no more than an error rate, a curve a method",
      .xLabel = fmt::format("{}, percent of {}", statistics.isSoft ? "mean |ΔV|" : "error rate",
                            suiteFigure(statistics).of),
      .yLabel = "scenes with no more, percent"};
  for (const std::string& method : shown) {
    const std::vector<double> errors = sortedErrors(statistics, method);
    if (errors.empty()) continue;
    left = std::min(left, errors.front());
    right = std::max(right, errors.back());
    // Its symbol at some of the scenes, of few at all.
    PlotCurve curve{method, fmt::format("{} pi {}", styles.of(method), 1 + errors.size() / 10), {}};
    for (std::size_t i = 0; i < errors.size(); ++i) {
      curve.points.push_back(
          {errors[i], 100 * static_cast<double>(i + 1) / static_cast<double>(errors.size())});
    }
    plot.curves.push_back(std::move(curve));
  }
  left = std::max(leastShown, left / 1.2);
  plot.axes = fmt::format("set logscale x\nset xrange [{}:{}]\nset yrange [0:100]\n",
                          exactText(left), exactText(std::min(100.0, 1.2 * right)));
  const double uncertainty = largestUncertainty(statistics);
  if (uncertainty > left) plot.band = {{left, 100}, {uncertainty, 100}};
  return plot;
}

// ---- the bins

constexpr std::array<const char*, 4> plottedAxes = {"curvature_height", "elevation", "shadow_reach",
                                                    "uv_stretch"};

/// Without curves where the axis has fewer than two bins.
LinePlot binsPlot(const study::SuiteStatistics& statistics, const std::string& axis,
                  const std::vector<std::string>& shown, const MethodStyles& styles) {
  std::vector<BinEnds> ends;
  for (const study::SuiteBin& bin : statistics.bins) {
    if (bin.axis == axis) appendOnce(ends, BinEnds{bin.low, bin.high});
  }
  std::sort(ends.begin(), ends.end());
  LinePlot plot{.name = "suite-bins_" + axis,
                .title = "Error by " + axisTitle(axis),
                .about = "Error rate of each method by " + axisTitle(axis),
                .section = "bins",
                .xLabel = axisTitle(axis),
                .yLabel = binErrorAxis(statistics.isSoft)};
  if (ends.size() < 2) return plot;
  const BinAxis places = binAxis(ends);
  const auto shownError = [](double share) { return std::max(leastShown, 100 * share); };
  double least = 100;
  double most = leastShown;
  for (const std::string& method : shown) {
    PlotCurve curve{method, styles.of(method), {}};
    for (const study::SuiteBin& bin : statistics.bins) {
      if (bin.method != method || bin.axis != axis) continue;
      const auto at = std::find(ends.begin(), ends.end(), BinEnds{bin.low, bin.high});
      PlotPoint point{places.middles[static_cast<std::size_t>(at - ends.begin())],
                      shownError(bin.error.errorRate)};
      if (const auto& bar = bin.error.interval) {
        point.bar = compare::Interval{shownError(bar->low), shownError(bar->high)};
      }
      least = std::min(least, *point.y);
      most = std::max(most, *point.y);
      curve.points.push_back(point);
    }
    std::sort(curve.points.begin(), curve.points.end(),
              [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; });
    if (!curve.points.empty()) plot.curves.push_back(std::move(curve));
  }
  plot.axes = places.commands + fmt::format("set logscale y\nset yrange [{}:{}]\n",
                                            exactText(least / 1.5), exactText(1.5 * most));
  const double uncertainty = largestUncertainty(statistics);
  if (uncertainty > leastShown) {
    plot.band = {{places.left, uncertainty}, {places.right, uncertainty}};
  }
  return plot;
}

// ---- the matrix of wins

/// A colour between white and another.
std::string tint(const std::array<int, 3>& full, double strength) {
  const auto part = [&](int channel) {
    return static_cast<int>(std::lround(255 + strength * (channel - 255)));
  };
  return fmt::format("0x{:02x}{:02x}{:02x}", part(full[0]), part(full[1]), part(full[2]));
}

std::string cellColour(const study::SuitePair& pair) {
  if (!study::isDistinguishable(pair.verdict)) return "0xfefefe";  // on dark pages, too
  const double lead = 2 * pair.wins.probability - 1;
  constexpr std::array<int, 3> blue = {0x00, 0x72, 0xb2};
  constexpr std::array<int, 3> orange = {0xd5, 0x5e, 0x00};
  return tint(lead > 0 ? blue : orange, std::abs(lead));
}

/// White on strong tints.
std::string textColour(const study::SuitePair& pair) {
  if (!study::isDistinguishable(pair.verdict)) return "0x5c636c";
  return std::abs(2 * pair.wins.probability - 1) > 0.6 ? "0xfefefe" : "0x1a1d22";
}

}  // namespace

std::vector<LinePlot> suitePlots(const study::SuiteStatistics& statistics,
                                 const std::vector<std::string>& shown) {
  if (statistics.methods.empty()) return {};
  const MethodStyles styles(statistics, shown);
  std::vector<LinePlot> plots = {errorsPlot(statistics, shown, styles)};
  for (const char* axis : plottedAxes) {
    LinePlot plot = binsPlot(statistics, axis, shown, styles);
    if (!plot.curves.empty()) plots.push_back(std::move(plot));
  }
  return plots;
}

PlotSheet suiteWinsPlot(const study::SuiteStatistics& statistics) {
  std::vector<std::string> ranked;
  for (const study::SuiteMethod& method : statistics.methods) {
    if (method.rank) ranked.push_back(method.label);
  }
  std::string cells;
  std::string texts;
  std::string rowNames;
  std::string columnNames;
  for (std::size_t r = 0; r < ranked.size(); ++r) {
    const char* comma = r > 0 ? ", " : "";
    const std::string name = fmt::format("{}  {}", shortLegend(ranked[r]), r + 1);
    rowNames += fmt::format("{}{} {}", comma, gnuplotText(name), r);
    columnNames += fmt::format("{}'{}' {}", comma, r + 1, r);
    for (std::size_t c = 0; c < ranked.size(); ++c) {
      const auto pair = study::findPair(statistics, ranked[r], ranked[c]);
      if (r == c || !pair) {
        cells += fmt::format("{} {} 0xe6e8eb\n", c, r);
        continue;
      }
      cells += fmt::format("{} {} {}\n", c, r, cellColour(*pair));
      texts += fmt::format("{} {} \"{:.0f}{}\" {}\n", c, r, 100 * pair->wins.probability,
                           differenceSign(pair->verdict), textColour(*pair));
    }
  }
  constexpr int cellWidth = 34;
  constexpr int cellHeight = 26;
  constexpr int labelWidth = 320;
  constexpr int headHeight = 44;
  const int count = static_cast<int>(ranked.size());
  const int width = std::max(500, labelWidth + cellWidth * count + 20);
  const int height = headHeight + cellHeight * count + 16;
  const auto share = [](int pixels, int of) { return static_cast<double>(pixels) / of; };
  return {.name = "suite-wins",
          .title = "Who beats whom",
          .about =
              "Matrix of methods: the probability, in percent, that the method of the row has a "
              "smaller error than that of the column on a new scene",
          .section = "wins",
          .width = width,
          .height = height,
          .commands = fmt::format(
              "$cells << EOD\n{}EOD\n$texts << EOD\n{}EOD\n"
              "unset border\nunset key\nset tics scale 0 textcolor rgb '{}'\n"
              "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\n"
              "set tmargin at screen {:.4f}\nset bmargin at screen {:.4f}\n"
              "set ytics ({})\nset x2tics ({}) offset 0,-0.4\nunset xtics\n"
              "set xrange [-0.5:{}.5]\nset x2range [-0.5:{}.5]\nset yrange [{}.5:-0.5]\n"
              "plot $cells using 1:2:(0.48):(0.47):3 with boxxyerror fs solid 1 noborder lc rgb "
              "variable, \\\n  $texts using 1:2:3:4 with labels font ',10' tc rgb variable\n",
              cells, texts, inkColour, share(labelWidth, width),
              share(labelWidth + cellWidth * count, width), 1 - share(headHeight, height),
              share(16, height), rowNames, columnNames, count - 1, count - 1, count - 1)};
}

}  // namespace gnomon::report
