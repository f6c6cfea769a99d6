#include "compare/metric.h"

#include <fmt/core.h>

#include "common/error.h"

namespace gnomon::compare {

MetricId MetricId::of(std::string_view name) {
  if (const auto found = find(name)) return *found;
  throw InternalError(fmt::format("metric \"{}\" found, one of the table expected", name));
}

const std::vector<MetricId>& allMetrics() {
  static const std::vector<MetricId> all = [] {
    std::vector<MetricId> list;
    for (std::size_t place = 0; place < metricTraits.size(); ++place) {
      list.push_back(MetricId(place));
    }
    return list;
  }();
  return all;
}

std::vector<MetricId> metricsOfKinds(std::initializer_list<MetricKind> kinds) {
  std::vector<MetricId> list = allMetrics();
  std::erase_if(list, [&](MetricId id) {
    return std::find(kinds.begin(), kinds.end(), id.kind()) == kinds.end();
  });
  return list;
}

std::vector<std::string> namesOf(std::span<const MetricId> metrics) {
  std::vector<std::string> names;
  for (const MetricId id : metrics) names.emplace_back(id.name());
  return names;
}

const Metric& metricNamed(std::span<const Metric> metrics, MetricId id) {
  const auto found = std::find_if(metrics.begin(), metrics.end(),
                                  [&](const Metric& metric) { return metric.id == id; });
  if (found == metrics.end()) {
    throw InternalError(fmt::format("metric \"{}\" found, a measured one expected", id.name()));
  }
  return *found;
}

}  // namespace gnomon::compare
