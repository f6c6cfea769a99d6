#include "compare/share_metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "compare/answer_pair.h"
#include "compare/counts.h"

namespace gnomon::compare {
namespace {

constexpr std::string_view noSamples = "no samples";
constexpr std::string_view noArea = "the samples have no area";
constexpr std::string_view noUmbra = "neither the truth nor the candidate has an umbra";
constexpr std::string_view noPenumbra = "neither the truth nor the candidate has a penumbra";
constexpr std::string_view noRun = "no penumbra with both ends in view";
constexpr std::string_view fewRuns = "fewer than 30 penumbrae with both ends in view";

constexpr double farOff = 0.1;

/// The weight of the samples that either of two maps puts into a class, and that both do.
struct Overlap {
  double both = 0;
  double either = 0;

  void add(bool ours, bool theirs, double weight) {
    if (ours && theirs) both += weight;
    if (ours || theirs) either += weight;
  }
  [[nodiscard]] Metric metric(MetricId id, std::string_view otherwise) const {
    if (!(either > 0)) return {id, std::nullopt, otherwise};
    return {id, both / either, {}};
  }
};

bool isUmbra(double share) {
  return share < umbraTolerance;
}
bool isPenumbra(double share) {
  return share >= umbraTolerance && share <= 1 - umbraTolerance;
}

/// Sums over the samples that both maps hold.
struct ShareSums {
  double squares = 0;
  double far = 0;
  Overlap umbra, penumbra;

  void add(double ours, double theirs, double weight) {
    const double off = ours - theirs;
    squares += weight * off * off;
    if (std::abs(off) > farOff) far += weight;
    umbra.add(isUmbra(ours), isUmbra(theirs), weight);
    penumbra.add(isPenumbra(ours), isPenumbra(theirs), weight);
  }
};

}  // namespace

std::vector<Metric> shareMetrics(const Visibility& candidate, const Visibility& truth,
                                 std::span<const double> weights) {
  const Counts counts = countSamples(candidate, truth, weights);
  const Metric mae = rate(counts, metrics::errorRate);
  if (!mae.value) {
    const std::string_view reason = counts.samples == 0 ? noSamples : noArea;
    std::vector<Metric> none;
    for (const MetricId id : metricsOfKinds({MetricKind::share}))
      none.push_back({id, std::nullopt, reason});
    return none;
  }
  const SharePair pair(candidate, truth);
  ShareSums sums;
  for (std::size_t i = 0; i < pair.size(); ++i) {
    if (!pair.hasBoth(i)) continue;
    sums.add(pair.candidate(i), pair.truth(i), weights.empty() ? 1 : weights[i]);
  }
  const double all = counts.total();
  return {{"mae", mae.value, {}},
          {"rmse", std::sqrt(sums.squares / all), {}},
          {"off_by_more_than_0.1", sums.far / all, {}},
          sums.umbra.metric("umbra_iou", noUmbra),
          sums.penumbra.metric("penumbra_iou", noPenumbra)};
}

Mask penumbraMask(const Visibility& map) {
  Mask mask{map.width, map.height, {}};
  mask.samples.reserve(map.size());
  for (const float share : map.shares) {
    const auto value = static_cast<double>(share);
    const bool isInside = value > penumbraBegin && value < penumbraEnd;
    mask.samples.push_back(std::isnan(share) ? Shade::none
                           : isInside        ? Shade::shadowed
                                             : Shade::lit);
  }
  return mask;
}

std::vector<Metric> penumbraMetrics(const ShadowLengths& widths) {
  static_assert(leastRuns == 30, "the reason names it");
  const std::string_view reason = widths.runs == 0 ? noRun : fewRuns;
  const auto metric = [&](MetricId id, std::optional<double> value) -> Metric {
    return {id, value, value ? std::string_view() : reason};
  };
  return {metric("penumbra_width_ratio", widths.ratio),
          metric("penumbra_width_q1", widths.lowerQuartile),
          metric("penumbra_width_q3", widths.upperQuartile), metric("penumbra_runs", widths.runs)};
}

const std::vector<std::string_view>& shareReasons() {
  static const std::vector<std::string_view> reasons = {noSamples,  noArea, noUmbra,
                                                        noPenumbra, noRun,  fewRuns};
  return reasons;
}

}  // namespace gnomon::compare
