#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace gnomon::compare {

/// How one method's errors are spread over the scenes on which it was measured.
struct SceneSpread {
  std::size_t scenes = 0;  ///< with an error
  double mean = 0;
  double median = 0;  ///< quantiles as common/quantile.h: linear between neighbours in order
  double lowerQuartile = 0;
  double upperQuartile = 0;
  double percentile95 = 0;
  /// Mean of the worst twentieth of the scenes, rounded up to whole scenes: what is to be expected
  /// where the method does badly.
  double worstTwentieth = 0;
  double worst = 0;
  std::size_t worstScene = 0;  ///< index; of equal ones the first
  bool operator==(const SceneSpread&) const = default;
};

/// @param errors  one a scene; none where there is no error
/// @returns none where no scene has an error
std::optional<SceneSpread> spreadOver(std::span<const std::optional<double>> errors);

}  // namespace gnomon::compare
