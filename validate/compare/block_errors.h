#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/mask.h"
#include "common/visibility.h"

namespace gnomon::compare {

/// Where a mask is wrong, in square blocks of a view. Errors of neighbouring samples are
/// correlated, so a single sample is no independent observation; a block larger than the features
/// of the error nearly is.
struct BlockErrors {
  /// Weight of the samples on which mask and truth differ, one a block; of maps of visibility each
  /// sample's weight times |V - V_truth|.
  std::vector<double> wrong;
  std::vector<double> weight;  ///< weight of all samples, one a block; 0 for one without any
  /// A hash of the answers, sample by sample: two masks over the same view that differ share one
  /// with a probability of 2⁻⁶⁴. 0 where it is not known.
  std::uint64_t answers = 0;

  /// Whether both are of the same answers, to the sample.
  [[nodiscard]] bool answersAlike(const BlockErrors& other) const {
    return answers != 0 && answers == other.answers;
  }
  /// Σ wrong / Σ weight, the error rate; 0 without any sample.
  [[nodiscard]] double rate() const;
  /// Adds the same blocks of another case: another light in the same view.
  /// @throws InternalError where the number of blocks differs
  BlockErrors& operator+=(const BlockErrors& other);
};

/// The errors of a mask in blocks of `side` × `side` samples, row by row; those at the right and at
/// the bottom may be smaller. A sample that either mask lacks takes no part.
/// @param weights   one a sample, or empty for 1 each
/// @param selected  non-zero where a wrong sample counts (the weight is that of all samples), or
///   empty for everywhere
/// @throws InputError as `countSamples`; InternalError for a side below 1
BlockErrors blockErrors(const Mask& mask, const Mask& truth, int side,
                        std::span<const double> weights = {},
                        std::span<const std::uint8_t> selected = {});
BlockErrors blockErrors(const Visibility& map, const Visibility& truth, int side,
                        std::span<const double> weights = {},
                        std::span<const std::uint8_t> selected = {});

}  // namespace gnomon::compare
