#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/mask.h"
#include "common/visibility.h"

namespace gnomon::compare {

/// The confusion matrix of a candidate mask against the truth; *positive means shadowed*. Weighted
/// by area where weights are given: the four cells then sum to the area, not to the count.
///
/// Of two maps of visibility a sample is divided among the cells by its shares of shadow, S = 1 -
/// V: min(S, S_truth) is shadowed in both, min(V, V_truth) lit in both, max(0, S - S_truth) false
/// shadow, max(0, S_truth - S) false light (the smaller share is what both agree on; so for soft
/// classifications Pontius & Cheuk 2006). The four add up to the sample's weight. The error rate is
/// then the mean of |V - V_truth|; of shares of 0 and 1 all cells are those of the masks, to the
/// bit.
struct Counts {
  double truePositive = 0;   ///< shadowed in both
  double falsePositive = 0;  ///< false shadow: the candidate shadows what is lit
  double falseNegative = 0;  ///< false light: the candidate lights what is shadowed
  double trueNegative = 0;   ///< lit in both
  std::size_t samples = 0;   ///< how many samples were compared

  [[nodiscard]] double total() const {
    return truePositive + falsePositive + falseNegative + trueNegative;
  }
  /// The cell of one pair of answers, neither of them `none`.
  [[nodiscard]] double& cell(Shade candidate, Shade truth);
  Counts& operator+=(const Counts& other);
};

/// Compares where `selected` holds (everywhere, if it is empty) and both masks have a sample.
/// Sums run in one fixed order (a row at a time): the same input gives the same bits.
/// @param weights   one a sample, ≥ 0, or empty for 1 each
/// @param selected  non-zero where a sample takes part, or empty for all
/// @throws InputError if sizes differ, a weight is negative or not finite (selected or not), the
///   weights sum to more than a double holds, or where `selected` holds one mask has a sample and
///   the other has none (both come from the same view, so that is a fault, not a case)
Counts countSamples(const Mask& candidate, const Mask& truth, std::span<const double> weights = {},
                    std::span<const std::uint8_t> selected = {});

/// The same of two maps of visibility.
/// @throws likewise, and for a share that is not 0 to 1
Counts countSamples(const Visibility& candidate, const Visibility& truth,
                    std::span<const double> weights = {},
                    std::span<const std::uint8_t> selected = {});

/// The same of each class of samples: countSamples of those alone, to the bit.
/// @param classes  one a sample; those of `classCount` and more take no part
std::vector<Counts> countClasses(const Mask& candidate, const Mask& truth,
                                 std::span<const std::uint8_t> classes, std::size_t classCount,
                                 std::span<const double> weights = {});
std::vector<Counts> countClasses(const Visibility& candidate, const Visibility& truth,
                                 std::span<const std::uint8_t> classes, std::size_t classCount,
                                 std::span<const double> weights = {});

}  // namespace gnomon::compare
