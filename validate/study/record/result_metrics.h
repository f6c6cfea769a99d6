#pragma once

#include <string_view>
#include <vector>

#include "compare/rates.h"
#include "study/record/record.h"

namespace gnomon::study {

/// All metrics of one result: its rates, the boundaries of its shadows, their lengths, and of a
/// light with a disc, over all samples, its share metrics. Under such a light the rates are those
/// of the shares (see compare::Counts), boundaries and lengths those of the masks that they are cut
/// to.
/// @throws InternalError as `rates`
std::vector<compare::Metric> metricsOf(const ResultRecord& result);

/// One of them by name.
/// @throws InternalError for a name that `metricNames` does not have
compare::Metric metricOf(const ResultRecord& result, std::string_view name);

/// The names of all metrics, in their order: those under every light, then those of shares.
const std::vector<std::string_view>& metricNames();
/// The names of those under every light.
const std::vector<std::string_view>& pointLightMetricNames();

/// Whether a metric is one of `rates`. Its uncertainty is the share of samples that flip.
bool isRate(std::string_view name);

/// The truth's uncertainty in any other metric: how far the coarser truth's figure is from that of
/// a perfect mask. For lengths this is `lengthError`; a perfect mask has distance 0 between
/// boundaries, and 1 as boundary IoU and surface Dice; share metrics as perfectShareMetric.
/// Infinite where the coarser truth has no boundary to compare, so that nothing can be told apart;
/// 0 where its lengths could not be measured.
/// @throws InternalError for a rate or an unknown name
double metricUncertainty(const UncertaintyRecord& truth, std::string_view name);

}  // namespace gnomon::study
