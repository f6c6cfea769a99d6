#include "study/run/scene/cast_lengths.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "compare/share_metrics.h"

namespace gnomon::study {

compare::ShadowLengths castLengths(const Mask& mask, const truth::Truth& truth,
                                   const compare::LightField& field) {
  const std::array<const Mask*, 1> one = {&mask};
  return castLengths(one, truth, field).front();
}

std::vector<compare::ShadowLengths> castLengths(std::span<const Mask* const> masks,
                                                const truth::Truth& truth,
                                                const compare::LightField& field) {
  std::vector<std::uint8_t> isCast(truth.mask.size());
  std::transform(
      truth.regions.begin(), truth.regions.end(), isCast.begin(),
      [](truth::Region region) { return static_cast<std::uint8_t>(truth::isCastShadow(region)); });
  return compare::compareShadowLengths(masks, truth.mask, field, isCast);
}

std::vector<compare::Metric> sharesMetrics(const Visibility& candidate, const Visibility& truth,
                                           std::span<const double> weights,
                                           const compare::LightField& field) {
  std::vector<compare::Metric> metrics = compare::shareMetrics(candidate, truth, weights);
  const std::vector<compare::Metric> widths =
      compare::penumbraMetrics(compare::compareShadowLengths(compare::penumbraMask(candidate),
                                                             compare::penumbraMask(truth), field));
  metrics.insert(metrics.end(), widths.begin(), widths.end());
  return metrics;
}

}  // namespace gnomon::study
