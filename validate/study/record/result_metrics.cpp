#include "study/record/result_metrics.h"

#include <cmath>
#include <limits>

#include "common/lists.h"
#include "compare/boundaries.h"

namespace gnomon {
namespace {

constexpr std::string_view notInRegions = "measured over all samples together only";

std::vector<Metric> unmeasured(const std::vector<std::string_view>& names) {
  std::vector<Metric> metrics;
  metrics.reserve(names.size());
  for (const std::string_view name : names) metrics.push_back({name, {}, notInRegions});
  return metrics;
}

std::vector<Metric> boundariesOf(const ResultRecord& result) {
  return result.boundaries.empty() ? unmeasured(boundaryMetricNames()) : result.boundaries;
}

std::vector<Metric> lengthsOf(const ResultRecord& result) {
  return result.lengths ? lengthMetrics(*result.lengths) : unmeasured(lengthMetricNames());
}

/// What a mask that equals the truth has.
double perfect(std::string_view boundaryMetric) {
  return isBoundaryDistance(boundaryMetric) ? 0 : 1;
}

}  // namespace

std::vector<Metric> metricsOf(const ResultRecord& result) {
  std::vector<Metric> metrics = rates(result.counts);
  for (const auto& more : {boundariesOf(result), lengthsOf(result)}) {
    metrics.insert(metrics.end(), more.begin(), more.end());
  }
  return metrics;
}

Metric metricOf(const ResultRecord& result, std::string_view name) {
  if (isRate(name)) return rate(result.counts, name);
  return metricNamed(contains(lengthMetricNames(), name) ? lengthsOf(result) : boundariesOf(result),
                     name);
}

const std::vector<std::string_view>& metricNames() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> list = rateNames();
    for (const auto* more : {&boundaryMetricNames(), &lengthMetricNames()}) {
      list.insert(list.end(), more->begin(), more->end());
    }
    return list;
  }();
  return names;
}

bool isRate(std::string_view name) {
  return contains(rateNames(), name);
}

double metricUncertainty(const UncertaintyRecord& truth, std::string_view name) {
  if (contains(lengthMetricNames(), name)) return truth.lengthError.value_or(0);
  const auto& found =
      truth.boundaries.empty() ? unmeasured(boundaryMetricNames()) : truth.boundaries;
  const auto value = metricNamed(found, name).value;
  return value ? std::abs(*value - perfect(name)) : std::numeric_limits<double>::infinity();
}

}  // namespace gnomon
