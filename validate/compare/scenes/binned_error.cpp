#include "compare/scenes/binned_error.h"

#include <algorithm>
#include <vector>

namespace gnomon::compare {

std::optional<BinnedError> binnedError(std::span<const SceneShare> shares,
                                       const SceneResamples& resamples) {
  BinnedError bin;
  double wrong = 0;
  for (const SceneShare& share : shares) {
    bin.scenes += share.weight > 0 ? 1 : 0;
    bin.weight += share.weight;
    wrong += share.wrong;
  }
  if (bin.scenes == 0) return std::nullopt;
  bin.errorRate = wrong / bin.weight;
  bin.weight /= static_cast<double>(shares.size());
  if (bin.scenes < leastBinScenes) return bin;
  std::vector<double> residuals;
  residuals.reserve(shares.size());
  for (const SceneShare& share : shares) {
    residuals.push_back((share.wrong - bin.errorRate * share.weight) / bin.weight);
  }
  const auto around = ResampledMean(residuals, resamples).interval(0.05);
  if (!around) return bin;
  bin.interval = Interval{std::max(0.0, bin.errorRate + around->low),
                          std::min(1.0, bin.errorRate + around->high)};
  return bin;
}

}  // namespace gnomon::compare
