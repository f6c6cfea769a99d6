#include "study/record/result_metrics.h"

#include <cmath>
#include <limits>

#include "compare/boundaries.h"
#include "compare/share_metrics.h"

namespace gnomon::study {
namespace {

using compare::MetricKind;

constexpr std::string_view notInRegions = "measured over all samples together only";
constexpr std::string_view notOfShares =
    "measured over all samples together under a soft light only";

std::vector<compare::Metric> unmeasured(std::initializer_list<MetricKind> kinds,
                                        std::string_view reason = notInRegions) {
  std::vector<compare::Metric> metrics;
  for (const compare::MetricId id : compare::metricsOfKinds(kinds)) {
    metrics.push_back({id, {}, reason});
  }
  return metrics;
}

std::vector<compare::Metric> sharesOf(const std::vector<compare::Metric>& measured) {
  return measured.empty() ? unmeasured({MetricKind::share, MetricKind::penumbra}, notOfShares)
                          : measured;
}

std::vector<compare::Metric> boundariesOf(const std::vector<compare::Metric>& measured) {
  return measured.empty() ? unmeasured({MetricKind::boundary}) : measured;
}

std::vector<compare::Metric> lengthsOf(const ResultRecord& result) {
  return result.lengths ? compare::lengthMetrics(*result.lengths)
                        : unmeasured({MetricKind::length});
}

bool isOfShares(compare::MetricId id) {
  return id.kind() == MetricKind::share || id.kind() == MetricKind::penumbra;
}

}  // namespace

std::vector<compare::Metric> metricsOf(const ResultRecord& result) {
  std::vector<compare::Metric> metrics = compare::rates(result.counts);
  for (const auto& more : {boundariesOf(result.boundaries), lengthsOf(result), result.shares}) {
    metrics.insert(metrics.end(), more.begin(), more.end());
  }
  return metrics;
}

compare::Metric metricOf(const ResultRecord& result, compare::MetricId id) {
  if (id.kind() == MetricKind::rate) return compare::rate(result.counts, id);
  return compare::metricNamed(isOfShares(id)                    ? sharesOf(result.shares)
                              : id.kind() == MetricKind::length ? lengthsOf(result)
                                                                : boundariesOf(result.boundaries),
                              id);
}

double metricUncertainty(const UncertaintyRecord& truth, compare::MetricId id) {
  if (id.kind() == MetricKind::length) return truth.lengthError.value_or(0);
  const auto value =
      compare::metricNamed(isOfShares(id) ? sharesOf(truth.shares) : boundariesOf(truth.boundaries),
                           id)
          .value;
  return value ? std::abs(*value - id.perfect()) : std::numeric_limits<double>::infinity();
}

}  // namespace gnomon::study
