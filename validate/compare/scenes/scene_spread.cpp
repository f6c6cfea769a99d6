#include "compare/scenes/scene_spread.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "common/quantile.h"

namespace gnomon::compare {

std::optional<SceneSpread> spreadOver(std::span<const std::optional<double>> errors) {
  std::vector<double> sorted;
  SceneSpread spread;
  for (std::size_t s = 0; s < errors.size(); ++s) {
    if (!errors[s]) continue;
    if (sorted.empty() || *errors[s] > spread.worst) {
      spread.worst = *errors[s];
      spread.worstScene = s;
    }
    sorted.push_back(*errors[s]);
  }
  if (sorted.empty()) return std::nullopt;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t count = sorted.size();
  spread.scenes = count;
  spread.mean = std::accumulate(sorted.begin(), sorted.end(), 0.0) / static_cast<double>(count);
  spread.median = quantile(sorted, 0.5);
  spread.lowerQuartile = quantile(sorted, 0.25);
  spread.upperQuartile = quantile(sorted, 0.75);
  spread.percentile95 = quantile(sorted, 0.95);
  const std::size_t worst = (count + 19) / 20;
  spread.worstTwentieth =
      std::accumulate(sorted.end() - static_cast<std::ptrdiff_t>(worst), sorted.end(), 0.0) /
      static_cast<double>(worst);
  return spread;
}

}  // namespace gnomon::compare
