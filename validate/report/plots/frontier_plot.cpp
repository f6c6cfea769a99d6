#include "report/plots/frontier_plot.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>

#include "report/plots/gnuplot.h"
#include "report/plots/plot_style.h"
#include "report/text/number_text.h"

namespace gnomon::report {
namespace {

/// How a plot calls its price.
struct PriceWords {
  const char* name;
  const char* title;
  const char* about;
  const char* axis;
  const char* section;  ///< of the page that shows it
  double unit;          ///< of the axis, in prices
};

constexpr PriceWords byMemory = {
    "frontier",
    "Error against memory",
    "Error rate of each method against the memory of its tables and height map",
    "tables and height map, MB",
    "plots",
    1e6};
constexpr PriceWords byFrameTime = {"frontier_time",
                                    "Error against the time of a frame",
                                    "Error rate of each method against the time of its frame",
                                    "frame, ms",
                                    "cost",
                                    1};

/// A third more room on every side, in the logarithm.
std::string ranges(const std::vector<FrontierPoint>& points, double unit) {
  const auto [low, high] =
      std::minmax_element(points.begin(), points.end(),
                          [](const auto& a, const auto& b) { return a.errorRate < b.errorRate; });
  constexpr double room = 1.35;
  // An error of nothing has no place on a logarithmic axis.
  const double least = std::max(low->errorRate, 1e-5);
  return fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\n",
                     exactText(points.front().price / unit / room),
                     exactText(points.back().price / unit * room), exactText(100 * least / room),
                     exactText(100 * std::max(high->errorRate, least) * room));
}

std::string dataRow(const FrontierPoint& point, double unit) {
  return fmt::format("{} {}\n", exactText(point.price / unit), exactText(100 * point.errorRate));
}

/// Each method's name, and the label of the entry that its colour is of.
std::map<std::string, std::string> methodsOf(const std::vector<FrontierPoint>& points,
                                             const MethodStyles& styles) {
  std::map<std::string, std::string> methods;
  for (const FrontierPoint& point : points) {
    const auto [found, isNew] = methods.emplace(point.name, point.label);
    if (!styles.isHighlighted(found->second) && styles.isHighlighted(point.label)) {
      found->second = point.label;
    }
  }
  return methods;
}

}  // namespace

PlotSheet frontierPlot(const std::vector<FrontierPoint>& points, Price price,
                       const MethodStyles& styles) {
  const PriceWords& words = price == Price::memory ? byMemory : byFrameTime;
  std::vector<std::string> labels;
  std::vector<LegendEntry> legend;
  for (const auto& [name, label] : methodsOf(points, styles)) {
    labels.push_back(label);
    legend.push_back({label, name});
  }
  std::string rows;
  for (const FrontierPoint& point : points)
    rows += point.efficient ? dataRow(point, words.unit) : "";
  // On to the right end: a higher price need not be worse.
  const FrontierPoint best =
      *std::min_element(points.begin(), points.end(),
                        [](const auto& a, const auto& b) { return a.errorRate < b.errorRate; });
  rows += dataRow({"", "", points.back().price, best.errorRate}, words.unit);
  std::string data = plotData("$frontier", rows);
  std::string plot = "plot $frontier using 1:2 with steps lc rgb axis lw 2 title 'frontier'";
  for (const std::string& label : styles.drawnOrder(labels)) {
    const auto m =
        static_cast<std::size_t>(std::find(labels.begin(), labels.end(), label) - labels.begin());
    rows.clear();
    for (const FrontierPoint& point : points) {
      rows += point.name == legend[m].text ? dataRow(point, words.unit) : "";
    }
    data += plotData(fmt::format("$m{}", m), rows);
    plot += fmt::format(", \\\n  $m{} using 1:2 with points {} notitle", m,
                        styles.pointsOfMethod(label));
  }
  plot += styles.legend(legend, "points", &MethodStyles::pointsOfMethod);
  const std::string commands =
      data + plotFrame() + "set logscale xy\n" + ranges(points, words.unit) +
      "set format x '%g'\nset format y '%g'\n" + fmt::format("set xlabel '{}'\n", words.axis) +
      "set ylabel 'error rate, percent of the samples'\n"
      "set key outside right top Left reverse samplen 2 spacing 1.25\n" +
      plot + "\n";
  return {words.name, words.title, words.about,   1000,
          560,        commands,    words.section, styles.colours()};
}

}  // namespace gnomon::report
