#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "compare/confidence_interval.h"
#include "compare/scenes/resampled_mean.h"

namespace gnomon::compare {

/// What a scene gives to a bin: of its samples, those whose value on an axis lies there.
struct SceneShare {
  double weight = 0;  ///< their share of the scene's samples, 0 to 1
  double wrong = 0;   ///< the share of the scene's samples that lie there and are wrong
};

/// A method's error rate over the samples of all scenes that lie in a bin, each scene with the same
/// weight: R = Σ wrong / Σ weight.
struct BinnedError {
  std::size_t scenes = 0;  ///< with a sample in the bin
  double weight = 0;       ///< mean over all scenes
  double errorRate = 0;
  /// 95 %, by ResampledMean of (wrong - R weight) / mean weight over all scenes, which has the mean
  /// 0 and, to first order, the error of R; cut to 0 to 1. None in fewer than `leastBinScenes`.
  std::optional<Interval> interval;
};

/// Fewer scenes with a sample in a bin give no interval.
constexpr std::size_t leastBinScenes = 10;

/// @param shares  one a scene
/// @returns none where no scene has a sample there
std::optional<BinnedError> binnedError(std::span<const SceneShare> shares,
                                       const SceneResamples& resamples);

}  // namespace gnomon::compare
