#pragma once

#include <cstddef>
#include <vector>

namespace gnomon::compare {

/// What Holm's procedure (1979) makes of one of several comparisons. Decided by it, at most 5 of
/// 100 such families have any wrong rejection at all, however their comparisons depend on each
/// other.
struct HolmStep {
  double adjusted =
      1;  ///< p times the comparisons left, never falling from step to step; 1 or less
  /// The error that a comparison is allowed: 0.05 over the comparisons left, this one included. The
  /// first step that is no rejection ends the procedure, and all later ones get its error.
  double allowed = 0.05;
};

/// @param probabilities  p of each comparison, 0 to 1
/// @returns one a comparison, in their order; equal p in the order of input, which changes neither
///   what is rejected nor what is adjusted
std::vector<HolmStep> holmSteps(const std::vector<double>& probabilities);

/// Whether a p is small enough for an allowed error, both computed with rounding.
bool isRejected(double probability, double allowed);

}  // namespace gnomon::compare
