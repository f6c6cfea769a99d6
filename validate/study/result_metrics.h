#pragma once

#include <string_view>
#include <vector>

#include "compare/rates.h"
#include "study/record.h"

namespace gnomon {

/// All metrics of one result: its rates, then the lengths of its shadows.
/// @throws InternalError as `rates`
std::vector<Metric> metricsOf(const ResultRecord& result);

/// One of them by name.
/// @throws InternalError for a name that `metricNames` does not have
Metric metricOf(const ResultRecord& result, std::string_view name);

/// The names of all metrics, in their order.
const std::vector<std::string_view>& metricNames();

/// Whether a metric measures lengths: its uncertainty is the truth's `lengthError`, not the share
/// of samples that flip.
bool isLengthMetric(std::string_view name);

}  // namespace gnomon
