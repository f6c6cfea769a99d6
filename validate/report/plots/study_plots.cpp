#include "report/plots/study_plots.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "common/lists.h"
#include "compare/counts.h"
#include "report/plots/gnuplot.h"
#include "report/plots/line_plot.h"
#include "report/tables/cost_table.h"
#include "report/terminal_page.h"
#include "report/text/number_text.h"
#include "study/judge/ranking.h"
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
  const MethodStyles styles(means, shown);
  addBins(plots, record, shown, styles);
  addFrontiers(plots, record, means, shown, styles);
  return plots;
}

namespace {

/// The means of a slice's cases, in its order.
std::vector<study::StudyMeans> stepsOf(const study::SweepRecord& sweep, const SweepSlice& slice) {
  std::vector<study::StudyMeans> steps;
  for (const std::size_t i : slice.cases) steps.push_back(study::studyMeans(sweep.steps.at(i)));
  return steps;
}

/// The label; where the slice lacks cases of the method, with how many it is over.
std::string legendOf(const std::vector<study::StudyMeans>& steps, const std::string& label) {
  study::MethodMeans all{label, label, {}, {}, {}, {}};
  for (const study::StudyMeans& step : steps) {
    const study::MethodMeans* means = study::findMeans(step, label);
    const std::vector<std::optional<double>> errors =
        means != nullptr ? means->caseErrors
                         : std::vector<std::optional<double>>(study::caseCount(step));
    all.caseErrors.insert(all.caseErrors.end(), errors.begin(), errors.end());
  }
  return study::labelWithCases(all);
}

std::optional<double> inPercent(std::optional<double> share) {
  return share ? std::optional(100 * *share) : std::nullopt;
}

LinePlot errorPlot(const study::SweepRecord& sweep, const SweepSlice& slice,
                   const std::vector<std::string>& shown, const MethodStyles& styles) {
  const std::vector<study::StudyMeans> steps = stepsOf(sweep, slice);
  LinePlot plot{.name = "sweep" + slice.suffix,
                .title = slice.title.empty() ? sweep.heading()
                                             : fmt::format("{}, {}", sweep.heading(), slice.title),
                .about = "Error rate of each method against " + slice.axis,
                .section = sweepErrorSection,
                .xLabel = slice.axis,
                .yLabel = errorAxis(study::isSoft(sweep)),
                .axes = "set offsets graph 0.03, graph 0.03, graph 0.05, 0\nset yrange [0:*]\n" +
                        axisCommands(slice)};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    plot.band.push_back({slice.positions[i], inPercent(study::largestUncertainty(steps[i]))});
  }
  for (const std::string& method : shown) {
    PlotCurve curve{legendOf(steps, method), styles.of(method), {}};
    for (std::size_t i = 0; i < steps.size(); ++i) {
      PlotPoint point{slice.positions[i], {}};
      if (const study::MethodMeans* means = study::findMeans(steps[i], method)) {
        point.y = inPercent(means->errorRate);
        if (point.y && means->interval) {
          point.bar = compare::Interval{100 * means->interval->low, 100 * means->interval->high};
        }
      }
      curve.points.push_back(point);
    }
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

/// None where no method's memory changes.
std::optional<LinePlot> memoryPlot(const study::SweepRecord& sweep, const SweepSlice& slice,
                                   const std::vector<std::string>& shown,
                                   const MethodStyles& styles) {
  // An error of nothing has no place on a logarithmic axis.
  constexpr double leastShown = 1e-3;
  const std::vector<study::StudyMeans> steps = stepsOf(sweep, slice);
  LinePlot plot{
      .name = "sweep_memory",
      .title = "Error against memory",
      .about = "Error rate of each method against the memory of its tables and height map",
      .section = sweepCostSection,
      .xLabel = "tables and height map, MB",
      .yLabel = errorAxis(study::isSoft(sweep)),
      .axes = "set logscale xy\nset offsets graph 0.03, graph 0.03, 0, 0\n"};
  for (const std::string& method : shown) {
    PlotCurve curve{method, styles.of(method), {}};
    std::set<double> memories;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const study::MethodMeans* means = study::findMeans(steps[i], method);
      const study::CostRecord* cost = costOf(sweep.steps.at(slice.cases[i]), method);
      if (means == nullptr || cost == nullptr || memoryBytes(*cost) == 0) continue;
      if (!means->isInEveryCase() || !means->errorRate) continue;
      curve.points.push_back({static_cast<double>(memoryBytes(*cost)) / 1e6,
                              std::max(100 * *means->errorRate, leastShown)});
      memories.insert(curve.points.back().x);
    }
    if (memories.size() > 1) plot.curves.push_back(std::move(curve));
  }
  return plot.curves.empty() ? std::nullopt : std::optional(std::move(plot));
}

}  // namespace

std::vector<LinePlot> sweepPlots(const study::SweepRecord& sweep,
                                 const std::vector<std::string>& shown) {
  const MethodStyles styles(study::studyMeans(sweep), shown);
  const std::vector<SweepSlice> slices = slicesOf(sweep);
  std::vector<LinePlot> plots;
  for (const SweepSlice& slice : slices) plots.push_back(errorPlot(sweep, slice, shown, styles));
  if (slices.size() == 1) {
    if (auto memory = memoryPlot(sweep, slices.front(), shown, styles)) {
      plots.push_back(std::move(*memory));
    }
  }
  return plots;
}

namespace {

/// One dimension as an axis.
struct Dimension {
  std::string axis;
  std::vector<double> positions;        ///< one a case of the sweep
  std::vector<std::string> categories;  ///< of places that are no numbers
  std::vector<std::string> texts;       ///< "bake.bits = 8", one a case

  [[nodiscard]] std::set<double> places() const { return {positions.begin(), positions.end()}; }
};

/// What a case has in the keys.
std::string textIn(const study::SweepRecord& sweep, const std::vector<std::size_t>& keys,
                   std::size_t which) {
  std::string text;
  for (const std::size_t k : keys) {
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", sweep.keys[k].key,
                        sweep.cases[which].values.at(k).text);
  }
  return text;
}

/// Whether a key's values are numbers, and tell the steps of its dimension apart.
bool tellsApart(const study::SweepRecord& sweep, std::size_t key,
                const std::vector<std::string>& steps) {
  std::set<std::pair<double, std::string>> pairs;
  std::set<double> values;
  for (std::size_t i = 0; i < sweep.cases.size(); ++i) {
    const study::SweptValue& value = sweep.cases[i].values.at(key);
    if (!value.number) return false;
    values.insert(*value.number);
    pairs.emplace(*value.number, steps[i]);
  }
  return values.size() == pairs.size();
}

std::string shortText(const std::string& text) {
  constexpr std::size_t longest = 24;
  return displayWidth(text) > longest ? fitLeft(text, longest) : text;
}

Dimension dimensionOf(const study::SweepRecord& sweep, std::size_t dimension) {
  std::vector<std::size_t> keys;
  for (std::size_t k = 0; k < sweep.keys.size(); ++k) {
    if (sweep.keys[k].dimension == dimension) keys.push_back(k);
  }
  Dimension found;
  for (std::size_t i = 0; i < sweep.cases.size(); ++i)
    found.texts.push_back(textIn(sweep, keys, i));
  const auto axisKey = std::find_if(
      keys.begin(), keys.end(), [&](std::size_t k) { return tellsApart(sweep, k, found.texts); });
  const std::size_t shown = axisKey != keys.end() ? *axisKey : keys.front();
  found.axis = sweep.keys[shown].axis;
  for (const std::size_t k : keys) {
    if (k != shown) found.axis += fmt::format(", with {}", sweep.keys[k].axis);
  }
  std::vector<std::string> seen;
  for (std::size_t i = 0; i < sweep.cases.size(); ++i) {
    const study::SweptValue& value = sweep.cases[i].values.at(shown);
    if (axisKey != keys.end()) {
      found.positions.push_back(*value.number);
      continue;
    }
    const auto at = std::find(seen.begin(), seen.end(), found.texts[i]);
    found.positions.push_back(static_cast<double>(at - seen.begin()));
    if (at != seen.end()) continue;
    seen.push_back(found.texts[i]);
    found.categories.push_back(shortText(value.text));
  }
  return found;
}

std::vector<Dimension> dimensionsOf(const study::SweepRecord& sweep) {
  std::vector<Dimension> dimensions;
  const std::size_t count = study::dimensionCount(sweep.keys);
  if (sweep.cases.empty() || count > 2) return {};
  for (std::size_t d = 0; d < count; ++d) {
    dimensions.push_back(dimensionOf(sweep, d));
  }
  return dimensions;
}

/// The cases in the order of their positions.
SweepSlice sliceOf(const Dimension& axis, std::vector<std::size_t> cases) {
  std::stable_sort(cases.begin(), cases.end(), [&](std::size_t a, std::size_t b) {
    return axis.positions[a] < axis.positions[b];
  });
  SweepSlice slice;
  slice.axis = axis.axis;
  slice.categories = axis.categories;
  for (const std::size_t i : cases) slice.positions.push_back(axis.positions[i]);
  slice.cases = std::move(cases);
  return slice;
}

}  // namespace

std::vector<SweepSlice> slicesOf(const study::SweepRecord& sweep) {
  const std::vector<Dimension> dimensions = dimensionsOf(sweep);
  if (dimensions.empty()) return {};
  std::vector<std::size_t> all(sweep.cases.size());
  std::iota(all.begin(), all.end(), 0);
  if (dimensions.size() == 1) return {sliceOf(dimensions.front(), all)};
  const bool isFirstLonger = dimensions[0].places().size() >= dimensions[1].places().size();
  const Dimension& axis = dimensions[isFirstLonger ? 0 : 1];
  const Dimension& cut = dimensions[isFirstLonger ? 1 : 0];
  const std::set<double> places = cut.places();
  if (places.size() > mostSlices) return {};
  std::vector<SweepSlice> slices;
  for (const double place : places) {
    std::vector<std::size_t> cases;
    std::copy_if(all.begin(), all.end(), std::back_inserter(cases),
                 [&](std::size_t i) { return cut.positions[i] == place; });
    const std::string title = cut.texts[cases.front()];
    slices.push_back(sliceOf(axis, std::move(cases)));
    slices.back().title = title;
    slices.back().suffix = fmt::format("_{}", slices.size());
  }
  return slices;
}

std::string axisCommands(const SweepSlice& slice) {
  if (!slice.categories.empty()) {
    constexpr std::size_t mostLabels = 9;
    const std::size_t step = (slice.categories.size() + mostLabels - 1) / mostLabels;
    std::string tics;
    for (std::size_t i = 0; i < slice.categories.size(); i += step) {
      tics += fmt::format("{}{} {}", tics.empty() ? "" : ", ", gnuplotText(slice.categories[i]), i);
    }
    return "set xtics (" + tics + ")\n";
  }
  // Up to the values, not to the next tic: a radius of 0 has nothing below it.
  return std::string("set autoscale xfix\n") +
         (isGeometric(slice.positions) ? "set logscale x\n" : "");
}

}  // namespace gnomon::report
