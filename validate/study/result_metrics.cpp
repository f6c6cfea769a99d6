#include "study/result_metrics.h"

#include <algorithm>

namespace gnomon {
namespace {

Metric lengthMetric(const ResultRecord& result, std::size_t index) {
  if (result.lengths) return lengthMetrics(*result.lengths)[index];
  return {lengthMetricNames()[index], {}, "measured over all samples together only"};
}

}  // namespace

std::vector<Metric> metricsOf(const ResultRecord& result) {
  std::vector<Metric> metrics = rates(result.counts);
  for (std::size_t i = 0; i < lengthMetricNames().size(); ++i) {
    metrics.push_back(lengthMetric(result, i));
  }
  return metrics;
}

Metric metricOf(const ResultRecord& result, std::string_view name) {
  const auto& lengths = lengthMetricNames();
  const auto found = std::find(lengths.begin(), lengths.end(), name);
  if (found == lengths.end()) return rate(result.counts, name);
  return lengthMetric(result, static_cast<std::size_t>(found - lengths.begin()));
}

const std::vector<std::string_view>& metricNames() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> list = rateNames();
    list.insert(list.end(), lengthMetricNames().begin(), lengthMetricNames().end());
    return list;
  }();
  return names;
}

bool isLengthMetric(std::string_view name) {
  const auto& lengths = lengthMetricNames();
  return std::find(lengths.begin(), lengths.end(), name) != lengths.end();
}

}  // namespace gnomon
