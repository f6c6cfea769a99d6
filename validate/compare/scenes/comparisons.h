#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "compare/confidence_interval.h"
#include "compare/scenes/resampled_mean.h"

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

/// How often the first of two methods beats the second.
struct WinShare {
  std::size_t scenes = 0;  ///< on which both were measured
  std::size_t wins = 0;  ///< the first has the smaller error, by more than the truth's uncertainty
  std::size_t ties = 0;  ///< they differ by no more than that
  /// (wins + ties / 2) / scenes: the probability that the first beats the second on a new scene.
  double probability = 0;
  /// 95 %, by Wilson's score (1927): the p for which the share is no more than 1.96 standard
  /// deviations √(p (1 - p) / n) away. Ties vary less than wins do, so with ties it is rather too
  /// wide.
  Interval interval = {};
};

/// @param first, second  errors on the same scenes, at least one
/// @param uncertainty    of the truth, one a scene
/// @throws InternalError where the numbers of values differ or there is none
WinShare winShare(std::span<const double> first, std::span<const double> second,
                  std::span<const double> uncertainty);

/// Wilson's interval.
/// @param share  0 to 1
/// @param count  1 or more
Interval wilsonInterval(double share, std::size_t count);

/// The same of the second method.
WinShare swapped(const WinShare& share);

/// Kendall's τ-b of two rankings of the same things, -1 (opposite) to 1 (the same): of all pairs,
/// those in the same order less those in the opposite order, over √((n - t₁)(n - t₂)), where n is
/// the number of pairs and t₁, t₂ that of the pairs that are tied in one ranking and the other.
/// @param first, second  a value each: ranks, or what they follow from
/// @returns none where all are tied in one of them
/// @throws InternalError where the numbers of values differ
std::optional<double> kendallTau(std::span<const double> first, std::span<const double> second);

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
