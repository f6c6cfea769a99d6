#include "report/plots/frontier_plot.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/lists.h"
#include "report/plots/gnuplot.h"
#include "report/plots/plot_style.h"
#include "report/text/number_text.h"

namespace gnomon::report {
namespace {

/// A third more room on every side, in the logarithm.
std::string ranges(const std::vector<FrontierPoint>& points) {
  const auto [low, high] =
      std::minmax_element(points.begin(), points.end(),
                          [](const auto& a, const auto& b) { return a.errorRate < b.errorRate; });
  constexpr double room = 1.35;
  // An error of nothing has no place on a logarithmic axis.
  const double least = std::max(low->errorRate, 1e-5);
  return fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\n",
                     exactText(points.front().bytes / 1e6 / room),
                     exactText(points.back().bytes / 1e6 * room), exactText(100 * least / room),
                     exactText(100 * std::max(high->errorRate, least) * room));
}

std::string dataRow(const FrontierPoint& point) {
  return fmt::format("{} {}\n", exactText(point.bytes / 1e6), exactText(100 * point.errorRate));
}

}  // namespace

PlotSheet frontierPlot(const std::vector<FrontierPoint>& points) {
  std::vector<std::string> names;
  for (const FrontierPoint& point : points) {
    appendOnce(names, point.name);
  }
  std::string rows;
  for (const FrontierPoint& point : points) rows += point.efficient ? dataRow(point) : "";
  // On to the right end: more memory need not be worse.
  const FrontierPoint best =
      *std::min_element(points.begin(), points.end(),
                        [](const auto& a, const auto& b) { return a.errorRate < b.errorRate; });
  rows += dataRow({"", "", points.back().bytes, best.errorRate});
  std::string data = plotData("$frontier", rows);
  std::string plot = "plot $frontier using 1:2 with steps lc rgb '#9aa1a9' lw 2 title 'frontier'";
  for (std::size_t m = 0; m < names.size(); ++m) {
    rows.clear();
    for (const FrontierPoint& point : points) rows += point.name == names[m] ? dataRow(point) : "";
    data += plotData(fmt::format("$m{}", m), rows);
    plot += fmt::format(", \\\n  $m{} using 1:2 with points lc rgb '{}' pt {} ps 1 lw 2 title {}",
                        m, plotColours.at(m % plotColours.size()),
                        plotPoints.at((m + m / plotColours.size()) % plotPoints.size()),
                        plotLegend(names[m]));
  }
  const std::string commands = data + plotFrame() + "set logscale xy\n" + ranges(points) +
                               "set format x '%g'\nset format y '%g'\n"
                               "set xlabel 'tables and height map, MB'\n"
                               "set ylabel 'error rate, percent of the samples'\n"
                               "set key outside right top Left reverse samplen 2 spacing 1.25\n" +
                               plot + "\n";
  return {"frontier",
          "Error against memory",
          "Error rate of each method against the memory of its tables and height map",
          1000,
          560,
          commands};
}

}  // namespace gnomon::report
