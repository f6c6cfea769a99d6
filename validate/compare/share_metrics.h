#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "common/mask.h"
#include "compare/counts.h"
#include "compare/shadow_length.h"

namespace gnomon::compare {

/// Where V is below this a sample lies in umbra, where it is above 1 less this it sees the whole
/// disc: half a ray of the truth's 256.
constexpr double umbraTolerance = 1.0 / 512;
/// The penumbra whose width is measured runs from one of these shares to the other.
constexpr double penumbraBegin = 0.1;
constexpr double penumbraEnd = 0.9;

/// How two maps of visibility differ, over the samples that both hold, by weight w; in this order:
///
///   mae                   Σ w |ΔV| / Σ w, ΔV = V - V_truth: `error_rate` of their `Counts`
///   rmse                  √(Σ w ΔV² / Σ w)
///   off_by_more_than_0.1  the share of the weight where |ΔV| > 0.1
///   umbra_iou             weight where both are below `umbraTolerance` over that where one is;
///                         undefined where neither is anywhere
///   penumbra_iou          likewise where V is from that tolerance to 1 less that
///
/// On maps of 0 and 1 mae, rmse² and off_by_more_than_0.1 are the masks' error rate.
/// @param weights  one a sample, or empty for 1 each
/// @throws InputError as `countSamples` of two maps
std::vector<Metric> shareMetrics(const Visibility& candidate, const Visibility& truth,
                                 std::span<const double> weights = {});

/// Where a map is in the penumbra whose width is measured, `penumbraBegin` < V < `penumbraEnd`, as
/// a mask: there shadowed, elsewhere lit.
Mask penumbraMask(const Visibility& map);

/// The widths of penumbrae along the light, the candidate's over the truth's:
/// `compareShadowLengths` of their penumbra masks, over all samples, as metrics:
///   penumbra_width_ratio  the median: 1 as wide as the truth's, 0 a hard edge
///   penumbra_width_q1     lower quartile
///   penumbra_width_q3     upper quartile
///   penumbra_runs         width of all penumbrae measured, in samples across the light
/// A penumbra narrower than `leastRunSamples` samples is not measured.
std::vector<Metric> penumbraMetrics(const ShadowLengths& widths);

/// All reasons why one of them has no value.
const std::vector<std::string_view>& shareReasons();

}  // namespace gnomon::compare
