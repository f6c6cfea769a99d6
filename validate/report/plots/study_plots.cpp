#include "report/plots/study_plots.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "common/lists.h"
#include "compare/counts.h"
#include "report/tables/cost_table.h"
#include "report/text/number_text.h"
#include "study/record/cases.h"
#include "study/record/record.h"
#include "study/spec/sections/study_files.h"

namespace gnomon::report {
namespace {

// ---- bins

/// The truth's uncertainty in a view, mean over its lights, percent; 0 where it was not measured.
double uncertaintyIn(const study::StudyRecord& record, std::string_view view) {
  double sum = 0;
  double lights = 0;
  for (const study::UncertaintyRecord& flip : record.truth.flips) {
    if (flip.view != view) continue;
    sum += flip.flipRate;
    ++lights;
  }
  return lights > 0 ? 100 * sum / lights : 0;
}

/// None of fewer than two bins: as of the curvature of a plane, there is no curve to draw.
std::optional<LinePlot> binPlot(const study::StudyRecord& record, const std::string& axis,
                                const std::string& view, const std::vector<std::string>& shown,
                                const MethodStyles& styles) {
  std::vector<const study::BinRecord*> bins;
  std::vector<BinEnds> ends;
  for (const study::BinRecord& bin : record.bins) {
    if (bin.axis != axis || bin.view != view || bin.light != study::allLights) continue;
    bins.push_back(&bin);
    appendOnce(ends, BinEnds{bin.low, bin.high});
  }
  if (ends.size() < 2) return std::nullopt;
  std::sort(ends.begin(), ends.end());
  const BinAxis places = binAxis(ends);
  const std::string title = axisTitle(axis);
  const double uncertainty = uncertaintyIn(record, view);
  LinePlot plot{.name = fmt::format("error-by-{}", axis),
                .title = fmt::format("Error by {} ({})", title, view),
                .about = fmt::format("Error rate of each method by {}, view {}", title, view),
                .xLabel = title,
                .yLabel = binErrorAxis(study::isSoft(record)),
                .axes = places.commands + "set yrange [0:*]\n",
                .band = {{places.left, uncertainty}, {places.right, uncertainty}}};
  for (const std::string& method : shown) {
    PlotCurve curve{method, styles.of(method), {}};
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const auto bin = std::find_if(bins.begin(), bins.end(), [&](const study::BinRecord* one) {
        return one->method == method && BinEnds{one->low, one->high} == ends[i];
      });
      std::optional<double> error;
      if (bin != bins.end()) error = compare::rate((*bin)->counts, "error_rate").value;
      if (error) error = 100 * *error;
      curve.points.push_back({places.middles[i], error});
    }
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

void addBins(std::vector<LinePlot>& plots, const study::StudyRecord& record,
             const std::vector<std::string>& shown, const MethodStyles& styles) {
  std::vector<std::string> axes;
  std::vector<std::string> views;
  for (const study::BinRecord& bin : record.bins) {
    appendOnce(axes, bin.axis);
    appendOnce(views, bin.view);
  }
  const std::vector<std::string> files = study::fileNames(views);
  for (const std::string& axis : axes) {
    for (std::size_t i = 0; i < views.size(); ++i) {
      auto plot = binPlot(record, axis, views[i], shown, styles);
      if (!plot) continue;
      plot->name += "_" + files[i];
      plots.push_back(std::move(*plot));
    }
  }
}

// ---- frontiers

/// The least error that a logarithmic axis shows, percent: an error of nothing has no place there.
constexpr double leastError = 1e-3;

PlotPoint pointOf(const FrontierPoint& point, double unit) {
  return {point.price / unit, std::max(100 * point.errorRate, leastError)};
}

LinePlot frontierPlot(const std::vector<FrontierPoint>& points, double unit,
                      const study::StudyMeans& means, const std::vector<std::string>& shown,
                      const MethodStyles& styles) {
  constexpr double room = 1.35;  // on every side
  const double left = points.front().price / unit / room;
  const double right = points.back().price / unit * room;
  const double uncertainty = 100 * study::largestUncertainty(means).value_or(0);
  double low = std::max(uncertainty, leastError);
  double high = low;
  PlotCurve best{
      "no method is cheaper and better", fmt::format("lc rgb '{}' lw 2", axisColour), {}, "steps"};
  for (const FrontierPoint& point : points) {
    const PlotPoint at = pointOf(point, unit);
    low = std::min(low, *at.y);
    high = std::max(high, *at.y);
    if (point.efficient) best.points.push_back(at);
  }
  // On to the right end: a higher price need not be worse.
  best.points.push_back({right, best.points.back().y});
  LinePlot plot{.yLabel = errorAxis(means.isSoft),
                .axes = fmt::format("set logscale xy\nset xrange [{}:{}]\nset yrange [{}:{}]\n",
                                    exactText(left), exactText(right), exactText(low / room),
                                    exactText(high * room)),
                .curves = {std::move(best)}};
  if (uncertainty > leastError) plot.band = {{left, uncertainty}, {right, uncertainty}};
  std::vector<std::string> drawn;  // names
  for (const std::string& label : shown) {
    const auto own = std::find_if(points.begin(), points.end(),
                                  [&](const FrontierPoint& point) { return point.label == label; });
    if (own == points.end() || contains(drawn, own->name)) continue;
    drawn.push_back(own->name);
    PlotCurve curve{own->name, styles.of(label), {}, "points"};
    for (const FrontierPoint& point : points) {
      if (point.name == own->name) curve.points.push_back(pointOf(point, unit));
    }
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

void addFrontiers(std::vector<LinePlot>& plots, const study::StudyRecord& record,
                  const study::StudyMeans& means, const std::vector<std::string>& shown,
                  const MethodStyles& styles) {
  if (const auto points = frontier(record, Price::memory); !points.empty()) {
    LinePlot plot = frontierPlot(points, 1e6, means, shown, styles);
    plot.name = "frontier";
    plot.title = "Error against memory";
    plot.about = "Error rate of each method against the memory of its tables and height map";
    plot.xLabel = "tables and height map, MB";
    plots.push_back(std::move(plot));
  }
  if (const auto points = frontier(record, Price::frameTime); !points.empty()) {
    LinePlot plot = frontierPlot(points, 1, means, shown, styles);
    plot.name = "frontier_time";
    plot.title = "Error against the time of a frame";
    plot.about = "Error rate of each method against the time of its frame";
    plot.section = "cost";
    plot.xLabel = "frame, ms";
    plots.push_back(std::move(plot));
  }
}

}  // namespace

std::vector<LinePlot> studyPlots(const study::StudyRecord& record,
                                 const std::vector<std::string>& shown) {
  std::vector<LinePlot> plots;
  const study::StudyMeans means = study::studyMeans(record);
  const MethodStyles styles(means);
  addBins(plots, record, shown, styles);
  addFrontiers(plots, record, means, shown, styles);
  return plots;
}

}  // namespace gnomon::report
