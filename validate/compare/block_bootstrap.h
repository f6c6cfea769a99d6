#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/mask.h"

namespace gnomon {

/// Where a mask is wrong, in square blocks of a view. Neighbouring samples err together, so that a
/// sample alone is no independent observation; a block larger than the features of the error
/// nearly is.
struct BlockErrors {
  std::vector<double> wrong;  ///< weight of the samples on which mask and truth differ, one a block
  std::vector<double> weight;  ///< weight of all samples, one a block; 0 for one without any

  /// Σ wrong / Σ weight, the error rate; 0 without any sample.
  [[nodiscard]] double rate() const;
  /// Blocks that hold a sample.
  [[nodiscard]] std::size_t count() const;
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

/// A confidence interval, both ends included.
struct Interval {
  double low = 0;
  double high = 0;

  /// Whether it holds a number.
  [[nodiscard]] bool holds(double value) const { return low <= value && value <= high; }
};

struct BootstrapSettings {
  int resamples = 1000;
  double confidence = 0.95;
  std::uint64_t seed = 1978;
};

/// The confidence interval of before.rate() - after.rate(), two answers at the same samples: the
/// block bootstrap (Efron 1979; of blocks, Künsch 1989). As many blocks as there are are drawn with
/// replacement, the same ones for both answers, so that what they have in common cancels; the
/// interval is that between the percentiles of the differences of all resamples.
/// The same input gives the same bits: the generator and what is made of its numbers are fixed.
/// @throws InternalError where the blocks of both differ in number, fewer than two hold a sample,
/// or
///   the settings have no resample or a confidence outside 0 to 1
Interval differenceInterval(const BlockErrors& before, const BlockErrors& after,
                            const BootstrapSettings& settings = {});

/// The same for one rate alone.
Interval rateInterval(const BlockErrors& errors, const BootstrapSettings& settings = {});

}  // namespace gnomon
