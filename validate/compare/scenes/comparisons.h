#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/confidence_interval.h"
#include "compare/scenes/resampled_mean.h"

namespace gnomon::compare {
/// Statistics over scenes: the scenes are drawn from one population, each independently of the
/// others, and the scene is the unit. An interval speaks of further scenes of that population.

/// Error rates of methods on scenes, 0 to 1.
struct SceneTable {
  std::vector<std::string> scenes;   ///< distinct names
  std::vector<std::string> methods;  ///< distinct names
  /// `errors[m][s]`: of method m on scene s; none where it was not measured there.
  std::vector<std::vector<std::optional<double>>> errors;
  /// By how much the truth itself may be wrong, one a scene.
  std::vector<double> uncertainty;
};

/// The same table with scenes and methods in the order of their names. All functions of this folder
/// add in the order of the table: sorted first, no result depends on the order of input.
/// @throws InternalError for sizes that do not fit, for a name twice, and for an error that is not
///   within 0 to 1 or an uncertainty that is not finite and 0 or more
SceneTable sortedByName(const SceneTable& table);

/// The scenes on which all of the methods have an error, ascending.
/// @param methods  indices
std::vector<std::size_t> sharedScenes(const SceneTable& table,
                                      const std::vector<std::size_t>& methods);

/// How one method's errors are spread over the scenes on which it was measured.
struct SceneSpread {
  std::size_t scenes = 0;  ///< with an error
  double mean = 0;
  double median = 0;  ///< quantiles as common/lists.h: linear between neighbours in order
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
