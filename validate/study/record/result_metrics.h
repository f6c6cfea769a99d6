#pragma once

#include <string_view>
#include <vector>

#include "compare/counts.h"
#include "study/record/record.h"

namespace gnomon::study {

/// All metrics of one result: its rates, the boundaries of its shadows, their lengths, and of a
/// light with a disc, over all samples, its share metrics. Under such a light the rates are those
/// of the shares (see compare::Counts), boundaries and lengths those of the masks that they are cut
/// to.
/// @throws InternalError as `rates`
std::vector<compare::Metric> metricsOf(const ResultRecord& result);

/// One of them.
compare::Metric metricOf(const ResultRecord& result, compare::MetricId id);

/// The truth's uncertainty in a metric that is no rate (there it is the share of samples that
/// flip): how far the coarser truth's figure is from that of a perfect mask. For lengths this is
/// `lengthError`; a perfect mask has distance 0 between boundaries, and 1 as boundary IoU and
/// surface Dice (MetricId::perfect). Infinite where the coarser truth has no boundary to compare,
/// so that nothing can be told apart; 0 where its lengths could not be measured.
/// @throws InternalError for a rate
double metricUncertainty(const UncertaintyRecord& truth, compare::MetricId id);

}  // namespace gnomon::study
