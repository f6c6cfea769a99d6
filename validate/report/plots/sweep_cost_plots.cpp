#include "report/plots/sweep_cost_plots.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <set>

#include "report/plots/gnuplot.h"
#include "report/plots/method_styles.h"
#include "report/plots/plot_style.h"
#include "report/tables/cost_table.h"
#include "report/text/number_text.h"
#include "study/judge/study_ranking.h"

namespace gnomon::report {
namespace {

/// One value of a method; none where it was not measured, an error none either where it lacks a
/// case.
struct Point {
  double value = 0;
  std::size_t place = 0;  ///< of the slice
  std::optional<double> megabytes, errorRate, frameMs;
};

struct Line {
  std::string label;
  std::vector<Point> points;  ///< by value
};

Point pointOf(const study::StudyRecord& step, double value, std::size_t place,
              const std::string& label) {
  Point point{value, place, {}, {}, {}};
  const study::StudyMeans study = study::studyMeans(step);
  const study::MethodMeans* means = study::findMeans(study, label);
  if (means != nullptr && means->isInEveryCase()) point.errorRate = means->errorRate;
  if (const study::CostRecord* cost = costOf(step, label)) {
    point.frameMs = cost->frameMs;
    const std::uint64_t bytes = memoryBytes(*cost);
    if (bytes > 0) point.megabytes = static_cast<double>(bytes) / 1e6;
  }
  return point;
}

std::vector<Line> linesOf(const study::SweepRecord& sweep, const SweepSlice& slice) {
  std::vector<Line> lines;
  for (const study::MethodMeans& method : study::studyMeans(sweep).methods) {
    Line line{method.label, {}};
    for (std::size_t i = 0; i < slice.cases.size(); ++i) {
      line.points.push_back(
          pointOf(sweep.steps.at(slice.cases[i]), slice.positions[i], i, method.label));
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

bool isTimed(const Line& line) {
  return std::any_of(line.points.begin(), line.points.end(),
                     [](const Point& point) { return point.frameMs && *point.frameMs > 0; });
}

bool tradesMemory(const Line& line) {
  std::set<double> memories;
  for (const Point& point : line.points) {
    if (point.megabytes && point.errorRate) memories.insert(*point.megabytes);
  }
  return memories.size() > 1;
}

/// Where a line has a point, and what a reader is told of it.
struct PlotPoint {
  std::optional<double> x, y;
  std::string words;
};

/// A sheet of lines over two axes.
/// @param pointOf  the place of a line's point; a gap where it has none
template <typename PointOf>
PlotSheet sheetOf(const std::vector<Line>& lines, const MethodStyles& styles, PlotPlace place,
                  const std::string& axes, const PointOf& pointOf) {
  PlotSheet sheet{.colours = styles.colours(), .place = place};
  std::string data;
  std::string plot;
  std::vector<std::string> labels;
  std::vector<LegendEntry> legend;
  for (const Line& line : lines) {
    labels.push_back(line.label);
    legend.push_back({line.label, line.label});
  }
  ValuePoints values("$values");
  for (const std::string& label : styles.drawnOrder(labels)) {
    const auto m =
        static_cast<std::size_t>(std::find(labels.begin(), labels.end(), label) - labels.begin());
    std::string rows;
    for (const Point& point : lines[m].points) {
      const PlotPoint at = pointOf(point);
      const bool isThere = at.x && at.y;
      rows += isThere ? fmt::format("{} {}\n", exactText(*at.x), exactText(*at.y)) : "NaN NaN\n";
      if (isThere) values.add(sheet, *at.x, *at.y, label + ": " + at.words);
    }
    values.endCurve();
    data += plotData(fmt::format("$m{}", m), rows);
    plot += fmt::format("{}$m{} using 1:2 with linespoints {} notitle",
                        plot.empty() ? "plot " : ", \\\n  ", m, styles.line(label));
  }
  plot += styles.legend(legend, "linespoints", &MethodStyles::line);
  sheet.legend = styles.items(legend, true);
  constexpr std::size_t linesOfPage = 22;
  constexpr int lineHeight = 24;
  const auto more = static_cast<int>(std::max(lines.size(), linesOfPage) - linesOfPage);
  if (place == PlotPlace::paper) sheet.height += more * lineHeight;
  if (place == PlotPlace::page) sheet.height = 460;
  if (place == PlotPlace::phone) {
    sheet.width = 380;
    sheet.height = 380;
  }
  sheet.commands = data + values.data(sheet) + plotFrame() + axes +
                   "set format y '%g'\nset offsets graph 0.03, graph 0.03, 0, 0\n" +
                   (place == PlotPlace::paper
                        ? "set key outside right top Left reverse samplen 2 spacing 1.1 maxcols 1\n"
                        : "unset key\n") +
                   plot + values.plot(sheet) + "\n";
  return sheet;
}

/// Figures behind a plot: a row a line, a column a value.
/// @param figureOf  of a point
template <typename FigureOf>
Table valuesTable(const std::vector<Line>& lines, const SweepSlice& slice, Quantity quantity,
                  const FigureOf& figureOf) {
  Table table{.kind = "values", .columns = {{"Method", "", Quantity::name}}};
  for (std::size_t i = 0; i < slice.positions.size(); ++i) {
    table.columns.push_back({placeText(slice, i), "", quantity});
  }
  for (const Line& line : lines) {
    Row row{{textCell(line.label)}};
    for (const Point& point : line.points) row.cells.push_back(figureOf(point));
    table.rows.push_back(std::move(row));
  }
  return table;
}

PlotSheet framePlot(std::vector<Line> lines, const SweepSlice& slice, const MethodStyles& styles,
                    PlotPlace place) {
  std::erase_if(lines, [](const Line& line) { return !isTimed(line); });
  PlotSheet sheet = sheetOf(
      lines, styles, place,
      "set logscale y\nset xlabel " + gnuplotText(slice.axis) +
          "\nset ylabel 'time of a frame, ms'\n" + axisCommands(slice),
      [&](const Point& point) {
        return PlotPoint{
            point.value, point.frameMs,
            fmt::format("{:.3g} ms, {}", point.frameMs.value_or(0), valueText(slice, point.place))};
      });
  sheet.name = "sweep_frames";
  sheet.title = "Time of a frame";
  sheet.about = "Time of a frame of each method against " + slice.axis;
  sheet.table = valuesTable(lines, slice, Quantity::decimals,
                            [](const Point& point) { return valueCell(point.frameMs); });
  return sheet;
}

PlotSheet memoryPlot(std::vector<Line> lines, const SweepSlice& slice,
                     const study::StudyMeans& means, const MethodStyles& styles, PlotPlace place) {
  std::erase_if(lines, [](const Line& line) { return !tradesMemory(line); });
  // An error of nothing has no place on a logarithmic axis.
  constexpr double leastShown = 1e-5;
  const std::optional<double> uncertainty = study::largestUncertainty(means);
  const bool hasBand = uncertainty && *uncertainty > leastShown;
  PlotSheet sheet = sheetOf(
      lines, styles, place,
      fmt::format("set logscale xy\nset format x '%g'\nset xlabel 'tables and height map, MB'\n"
                  "set ylabel '{}'\n",
                  errorAxis(means.isSoft)) +
          (hasBand ? plotBandBelow(100 * *uncertainty) : ""),
      [&](const Point& point) {
        const auto y = point.errorRate ? std::optional(100 * std::max(*point.errorRate, leastShown))
                                       : std::nullopt;
        return PlotPoint{point.megabytes, y,
                         fmt::format("{} % wrong, {:.3g} MB, {}", percentText(point.errorRate),
                                     point.megabytes.value_or(0), valueText(slice, point.place))};
      });
  if (hasBand) sheet.legend.push_back(bandItem());
  sheet.name = "sweep_memory";
  sheet.title = "Error against memory";
  sheet.about = "Error rate of each method against the memory of its tables and height map";
  sheet.table = valuesTable(lines, slice, Quantity::percent, [](const Point& point) {
    Cell cell = valueCell(point.errorRate);
    if (point.megabytes) cell.note = fmt::format("{:.3g} MB", *point.megabytes);
    return cell;
  });
  return sheet;
}

}  // namespace

std::vector<PlotSheet> sweepCostPlots(const study::SweepRecord& sweep, const SweepSlice& slice,
                                      PlotPlace place) {
  const std::vector<Line> lines = linesOf(sweep, slice);
  const study::StudyMeans means = study::studyMeans(sweep);
  const MethodStyles styles(means);
  std::vector<PlotSheet> sheets;
  if (std::any_of(lines.begin(), lines.end(), isTimed)) {
    sheets.push_back(framePlot(lines, slice, styles, place));
  }
  if (std::any_of(lines.begin(), lines.end(), tradesMemory)) {
    sheets.push_back(memoryPlot(lines, slice, means, styles, place));
  }
  return sheets;
}

}  // namespace gnomon::report
