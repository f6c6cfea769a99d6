#include "study/record/result_metrics.h"

#include <cmath>
#include <limits>

#include "common/lists.h"
#include "compare/boundaries.h"
#include "compare/share_metrics.h"

namespace gnomon::study {
namespace {

constexpr std::string_view notInRegions = "measured over all samples together only";
constexpr std::string_view notOfShares =
    "measured over all samples together under a soft light only";

std::vector<compare::Metric> unmeasured(const std::vector<std::string_view>& names,
                                        std::string_view reason = notInRegions) {
  std::vector<compare::Metric> metrics;
  metrics.reserve(names.size());
  for (const std::string_view name : names) metrics.push_back({name, {}, reason});
  return metrics;
}

bool isShareMetric(std::string_view name) {
  return contains(compare::shareMetricNames(), name);
}

std::vector<compare::Metric> sharesOf(const std::vector<compare::Metric>& measured) {
  return measured.empty() ? unmeasured(compare::shareMetricNames(), notOfShares) : measured;
}

std::vector<compare::Metric> boundariesOf(const ResultRecord& result) {
  return result.boundaries.empty() ? unmeasured(compare::boundaryMetricNames()) : result.boundaries;
}

std::vector<compare::Metric> lengthsOf(const ResultRecord& result) {
  return result.lengths ? compare::lengthMetrics(*result.lengths)
                        : unmeasured(compare::lengthMetricNames());
}

/// What a mask that equals the truth has.
double perfect(std::string_view metric) {
  if (isShareMetric(metric)) return compare::perfectShareMetric(metric);
  return compare::isBoundaryDistance(metric) ? 0 : 1;
}

}  // namespace

std::vector<compare::Metric> metricsOf(const ResultRecord& result) {
  std::vector<compare::Metric> metrics = compare::rates(result.counts);
  for (const auto& more : {boundariesOf(result), lengthsOf(result), result.shares}) {
    metrics.insert(metrics.end(), more.begin(), more.end());
  }
  return metrics;
}

compare::Metric metricOf(const ResultRecord& result, std::string_view name) {
  if (isRate(name)) return compare::rate(result.counts, name);
  if (isShareMetric(name)) return compare::metricNamed(sharesOf(result.shares), name);
  return compare::metricNamed(
      contains(compare::lengthMetricNames(), name) ? lengthsOf(result) : boundariesOf(result),
      name);
}

const std::vector<std::string_view>& metricNames() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> list = pointLightMetricNames();
    const auto& shares = compare::shareMetricNames();
    list.insert(list.end(), shares.begin(), shares.end());
    return list;
  }();
  return names;
}

const std::vector<std::string_view>& pointLightMetricNames() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> list = compare::rateNames();
    for (const auto* more : {&compare::boundaryMetricNames(), &compare::lengthMetricNames()}) {
      list.insert(list.end(), more->begin(), more->end());
    }
    return list;
  }();
  return names;
}

bool isRate(std::string_view name) {
  return contains(compare::rateNames(), name);
}

double metricUncertainty(const UncertaintyRecord& truth, std::string_view name) {
  if (contains(compare::lengthMetricNames(), name)) return truth.lengthError.value_or(0);
  const auto& found = isShareMetric(name)        ? sharesOf(truth.shares)
                      : truth.boundaries.empty() ? unmeasured(compare::boundaryMetricNames())
                                                 : truth.boundaries;
  const auto value = compare::metricNamed(found, name).value;
  return value ? std::abs(*value - perfect(name)) : std::numeric_limits<double>::infinity();
}

}  // namespace gnomon::study
