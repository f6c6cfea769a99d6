#pragma once

#include <cstddef>
#include <vector>

#include "compare/scenes/resampled_mean.h"

namespace gnomon::compare {

/// A method's rank by its mean error, and how much of it the draw of the scenes decides.
struct SceneRank {
  std::size_t rank = 1;  ///< 1 more than there are methods of a smaller mean
  double stability = 1;  ///< share of resamples of the scenes in which the rank is the same
  std::size_t low = 1;   ///< 95 % of the resamples have a rank from here …
  std::size_t high = 1;  ///< … to here: what 2.5 % of them at most are below, or above
};

/// @param errors  `errors[m][s]`, one a method and scene
std::vector<SceneRank> ranksOver(const std::vector<std::vector<double>>& errors,
                                 const SceneResamples& resamples);

}  // namespace gnomon::compare
