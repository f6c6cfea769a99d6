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
  std::optional<double> megabytes, errorRate, frameMs;
};

struct Line {
  std::string label;
  std::vector<Point> points;  ///< by value
};

Point pointOf(const study::StudyRecord& step, double value, const std::string& label) {
  Point point{value, {}, {}, {}};
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
          pointOf(sweep.steps.at(slice.cases[i]), slice.positions[i], method.label));
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

/// A sheet of lines over two axes.
/// @param row  x and y of one point; a gap where it is empty
template <typename Row>
PlotSheet sheetOf(const std::vector<Line>& lines, const MethodStyles& styles,
                  const std::string& axes, const Row& row) {
  std::string data;
  std::string plot;
  std::vector<std::string> labels;
  std::vector<LegendEntry> legend;
  for (const Line& line : lines) {
    labels.push_back(line.label);
    legend.push_back({line.label, line.label});
  }
  for (const std::string& label : styles.drawnOrder(labels)) {
    const auto m =
        static_cast<std::size_t>(std::find(labels.begin(), labels.end(), label) - labels.begin());
    std::string rows;
    for (const Point& point : lines[m].points) rows += row(point) + "\n";
    data += plotData(fmt::format("$m{}", m), rows);
    plot += fmt::format("{}$m{} using 1:2 with linespoints {} notitle",
                        plot.empty() ? "plot " : ", \\\n  ", m, styles.line(label));
  }
  plot += styles.legend(legend, "linespoints", &MethodStyles::line);
  constexpr std::size_t linesOfPage = 22;
  constexpr int lineHeight = 24;
  const auto more = static_cast<int>(std::max(lines.size(), linesOfPage) - linesOfPage);
  PlotSheet sheet;
  sheet.colours = styles.colours();
  sheet.height += more * lineHeight;
  sheet.commands =
      data + plotFrame() + axes + "set format y '%g'\nset offsets graph 0.03, graph 0.03, 0, 0\n" +
      "set key outside right top Left reverse samplen 2 spacing 1.1 maxcols 1\n" + plot + "\n";
  return sheet;
}

PlotSheet framePlot(std::vector<Line> lines, const SweepSlice& slice, const MethodStyles& styles) {
  std::erase_if(lines, [](const Line& line) { return !isTimed(line); });
  PlotSheet sheet = sheetOf(lines, styles,
                            "set logscale y\nset xlabel " + gnuplotText(slice.axis) +
                                "\nset ylabel 'time of a frame, ms'\n" + axisCommands(slice),
                            [](const Point& point) {
                              return fmt::format("{} {}", exactText(point.value),
                                                 point.frameMs ? exactText(*point.frameMs) : "NaN");
                            });
  sheet.name = "sweep_frames";
  sheet.title = "Time of a frame";
  sheet.about = "Time of a frame of each method against " + slice.axis;
  return sheet;
}

PlotSheet memoryPlot(std::vector<Line> lines, const MethodStyles& styles) {
  std::erase_if(lines, [](const Line& line) { return !tradesMemory(line); });
  PlotSheet sheet =
      sheetOf(lines, styles,
              "set logscale xy\nset format x '%g'\nset xlabel 'tables and height map, MB'\n"
              "set ylabel 'error rate, percent of the samples'\n",
              [](const Point& point) {
                if (!point.megabytes || !point.errorRate) return std::string("NaN NaN");
                // An error of nothing has no place on a logarithmic axis.
                return fmt::format("{} {}", exactText(*point.megabytes),
                                   exactText(100 * std::max(*point.errorRate, 1e-5)));
              });
  sheet.name = "sweep_memory";
  sheet.title = "Error against memory";
  sheet.about = "Error rate of each method against the memory of its tables and height map";
  return sheet;
}

}  // namespace

std::vector<PlotSheet> sweepCostPlots(const study::SweepRecord& sweep, const SweepSlice& slice) {
  const std::vector<Line> lines = linesOf(sweep, slice);
  const MethodStyles styles(study::studyMeans(sweep));
  std::vector<PlotSheet> sheets;
  if (std::any_of(lines.begin(), lines.end(), isTimed))
    sheets.push_back(framePlot(lines, slice, styles));
  if (std::any_of(lines.begin(), lines.end(), tradesMemory))
    sheets.push_back(memoryPlot(lines, styles));
  return sheets;
}

}  // namespace gnomon::report
