#include "report/plots/sweep_plots.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "report/plots/sweep_slices.h"
#include "report/tables/cost_table.h"
#include "report/text/number_text.h"
#include "study/judge/study_ranking.h"

namespace gnomon::report {
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
  const MethodStyles styles(study::studyMeans(sweep));
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

}  // namespace gnomon::report
