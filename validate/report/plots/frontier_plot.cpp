#include "report/plots/frontier_plot.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <optional>

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
  const char* unitName;
  const char* section;  ///< of the page that shows it
  double unit;          ///< of the axis, in prices
};

constexpr PriceWords byMemory = {
    "frontier",
    "Error against memory",
    "Error rate of each method against the memory of its tables and height map",
    "tables and height map, MB",
    "MB",
    "plots",
    1e6};
constexpr PriceWords byFrameTime = {"frontier_time",
                                    "Error against the time of a frame",
                                    "Error rate of each method against the time of its frame",
                                    "frame, ms",
                                    "ms",
                                    "cost",
                                    1};
constexpr PriceWords byTexels = {"frontier_texels",
                                 "Error against texels read",
                                 "Error rate of each method against the texels that it reads for a "
                                 "sample",
                                 "texels read for a sample",
                                 "texels",
                                 "cost",
                                 1};

const PriceWords& wordsOf(Price price) {
  switch (price) {
    case Price::memory:
      return byMemory;
    case Price::frameTime:
      return byFrameTime;
    case Price::texels:
      break;
  }
  return byTexels;
}

/// The least error that a logarithmic axis shows: an error of nothing has no place there.
constexpr double leastError = 1e-5;

/// A third more room on every side, in the logarithm.
std::string ranges(const std::vector<FrontierPoint>& points, double unit,
                   std::optional<double> uncertainty) {
  const auto [low, high] =
      std::minmax_element(points.begin(), points.end(),
                          [](const auto& a, const auto& b) { return a.errorRate < b.errorRate; });
  constexpr double room = 1.35;
  double least = std::max(low->errorRate, leastError);
  if (uncertainty && *uncertainty > leastError) least = std::min(least, *uncertainty);
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

/// The points behind the plot, by price.
Table valuesTable(const std::vector<FrontierPoint>& points, const PriceWords& words) {
  Table table{.kind = "values",
              .columns = {{"Method", "", Quantity::name},
                          {words.axis, "", Quantity::decimals},
                          {"Error", "", Quantity::percent},
                          {"On the frontier", "", Quantity::text}}};
  for (const FrontierPoint& point : points) {
    table.rows.push_back({{textCell(point.label), valueCell(point.price / words.unit),
                           valueCell(point.errorRate), textCell(point.efficient ? "yes" : "")}});
  }
  return table;
}

}  // namespace

PlotSheet frontierPlot(const std::vector<FrontierPoint>& points, Price price,
                       const MethodStyles& styles, std::optional<double> uncertainty,
                       PlotPlace place, bool isSoft) {
  const PriceWords& words = wordsOf(price);
  PlotSheet sheet{.name = words.name,
                  .title = words.title,
                  .about = words.about,
                  .section = words.section,
                  .colours = styles.colours(),
                  .place = place,
                  .table = valuesTable(points, words)};
  if (place == PlotPlace::page) sheet.height = 460;
  if (place == PlotPlace::phone) {
    sheet.width = 380;
    sheet.height = 380;
  }
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
  ValuePoints values("$values");
  for (const std::string& label : styles.drawnOrder(labels)) {
    const auto m =
        static_cast<std::size_t>(std::find(labels.begin(), labels.end(), label) - labels.begin());
    rows.clear();
    for (const FrontierPoint& point : points) {
      if (point.name != legend[m].text) continue;
      rows += dataRow(point, words.unit);
      values.add(sheet, point.price / words.unit, 100 * std::max(point.errorRate, leastError),
                 fmt::format("{}: {} % wrong, {:.3g} {}", point.label, percentText(point.errorRate),
                             point.price / words.unit, words.unitName));
    }
    values.endCurve();
    data += plotData(fmt::format("$m{}", m), rows);
    plot += fmt::format(", \\\n  $m{} using 1:2 with points {} notitle", m,
                        styles.pointsOfMethod(label));
  }
  plot += styles.legend(legend, "points", &MethodStyles::pointsOfMethod);
  sheet.legend = styles.items(legend, false);
  sheet.legend.push_back({.text = "frontier", .variable = "axis", .dash = 1});
  const bool hasBand = uncertainty && *uncertainty > leastError;
  if (hasBand) {
    plot += plotBandEntry();
    sheet.legend.push_back(bandItem());
  }
  const bool isPhone = place == PlotPlace::phone;
  sheet.commands =
      data + values.data(sheet) + plotFrame() + "set logscale xy\n" +
      ranges(points, words.unit, uncertainty) + (hasBand ? plotBandBelow(100 * *uncertainty) : "") +
      "set format x '%g'\nset format y '%g'\n" +
      fmt::format("set xlabel '{}' offset 0,0.5\n", words.axis) +
      (isPhone ? "set ylabel 'wrong, percent' offset 2,0\n"
               : fmt::format("set ylabel '{}'\n", errorAxis(isSoft))) +
      (place == PlotPlace::paper
           ? "set key outside right top Left reverse samplen 2 spacing 1.25\n"
           : "unset key\n" + plotMargins({isPhone ? 52 : 76, 12, 10, isPhone ? 64 : 68},
                                         sheet.width, sheet.height)) +
      plot + values.plot(sheet) + "\n";
  return sheet;
}

}  // namespace gnomon::report
