#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "common/mask.h"
#include "compare/block_errors.h"

namespace gnomon {

/// A confidence interval, both ends included.
struct Interval {
  double low = 0;
  double high = 0;

  /// Whether it holds a number.
  [[nodiscard]] bool holds(double value) const { return low <= value && value <= high; }
};

/// Of the bootstrap over blocks: Efron 1979; of blocks, Künsch 1989. The same settings and input
/// give the same bits: the generator and what is made of its numbers are fixed.
struct BootstrapSettings {
  int resamples = 1000;
  double confidence = 0.95;
  std::uint64_t seed = 1978;
};

/// The draws of a bootstrap. They depend on nothing but the settings and the number of blocks: what
/// takes many intervals of one view draws once. Several threads may use it at once.
class Bootstrap {
 public:
  Bootstrap() : Bootstrap(BootstrapSettings{}) {}
  explicit Bootstrap(const BootstrapSettings& settings) : settings_(settings) {}

  [[nodiscard]] const BootstrapSettings& settings() const { return settings_; }
  /// Which blocks each resample holds, one resample after the other: as many as there are.
  /// @param blocks  1 or more
  [[nodiscard]] const std::vector<std::uint32_t>& draws(std::size_t blocks) const;

 private:
  BootstrapSettings settings_;
  mutable std::mutex drawing_;
  mutable std::map<std::size_t, std::vector<std::uint32_t>> draws_;  ///< by the number of blocks
};

/// Confidence intervals of error rates, and of their differences, from the masks of one view.
///
/// *What varies.* A view's samples are no independent observations: a bump's shadow is wrong over
/// many of them at once, and under one light much as under the next. So a view is cut into square
/// blocks, larger than the relief's features, and these are what is drawn. Lights are settings that
/// a study chose, a handful, and no draw from a population: a block keeps all of its lights, which
/// are summed, and the interval speaks of other bumps under these lights.
///
/// *How many blocks.* Few and large (`leastBlocks`): then neighbours hardly share a feature, and
/// nothing need be known of how far errors are correlated. That 10 to 30 batches are enough, and
/// more do harm, is Schmeiser's result (1982) for means of correlated series; below are the figures
/// for masks.
///
/// *Which interval.* Percentiles of the resampled rates are too narrow for so few and so skewed
/// blocks. The studentised bootstrap (Efron & Tibshirani 1993, §12.5; of blocks, Lahiri 2003) draws
/// t* = (θ* - θ) / s* instead and takes [θ - s t*(97.5 %), θ - s t*(2.5 %)]. With block k's
/// deviation d_k = (wrong_k - rate · weight_k) / Σ weight, for a difference that of the first less
/// that of the second, s² = K / (K - 1) Σ d_k² (the linearised variance of a ratio).
///
/// *What neighbours share.* A feature that a block's border cuts lies in two blocks, so that s is
/// too small by a share that falls as 1 / side. From blocks of side b and of b / 2, its cells,
/// 2 s(b) - s(b/2) is free of that (Politis & Romano 1995 for series). The correction's own noise
/// is kept at bay: s is multiplied by 2 - s(b/2) / s(b), but by 1 to `largestCorrection`.
///
/// *Checked by simulation* (tests/compare/confidence_coverage_test.cpp): error masks of known rate,
/// level sets and contours of smooth random fields; rates 1 to 20 %, 1 to 5 lights, features from a
/// hundredth to a tenth of the view's side. The 95 % interval covers the rate 93 to 97 % of the
/// time (in single settings of 1,000 masks 92 to 97 %), where percentiles do 78 to 94 % of the
/// time. It is too narrow where the view has fewer than about ten features a side; too wide where
/// the rate drifts over the view, as toward a terminator, since that counts as a difference between
/// blocks: it then speaks of another part of such a surface. Rare and large errors, such that most
/// masks would hold a handful of them, often have none.
struct ConfidenceInterval {
  std::optional<Interval> interval;  ///< none where too little is known
  std::string_view reason;           ///< why there is none; empty if there is one
  std::size_t blocks = 0;            ///< that hold a sample
};

/// Fewer blocks than this give no interval.
constexpr std::size_t leastBlocks = 16;
/// Fewer blocks than this in which anything deviates from none at all give no interval: a resample
/// might hold none of them.
constexpr std::size_t leastWrongBlocks = 6;
/// Of the standard error, for what neighbouring blocks share.
constexpr double largestCorrection = 1.3;

/// How a view is cut: into cells, of which 2 × 2 are a block.
struct Tiling {
  int cellSide = 1;  ///< samples
  int columns = 1;   ///< of cells

  [[nodiscard]] int blockSide() const { return 2 * cellSide; }
};

/// The largest cells whose blocks come to no fewer than `leastBlocks` of equal weight: to that many
/// by (Σ w)² / Σ w², so that slivers at a silhouette do not count as blocks. In steps of a
/// twentieth; single samples, if nothing larger will do.
/// @param view     any mask of the view: says where samples are
/// @param weights  one a sample, or empty for 1 each
/// @throws InputError if the sizes differ
Tiling chooseTiling(const Mask& view, std::span<const double> weights = {});

/// The 95 % interval of an error rate, cut to 0 to 1.
/// @param cells  blockErrors of side `tiling.cellSide`, summed over lights
/// @throws InternalError where cells do not fill the tiling's columns, or for settings
///   without a resample or with a confidence outside 0 to 1
ConfidenceInterval rateConfidence(const BlockErrors& cells, const Tiling& tiling,
                                  const Bootstrap& bootstrap = Bootstrap());

/// The 95 % interval of first.rate() - second.rate(). The same blocks are drawn for both, so that
/// what they have in common cancels. Both may have other weights, or samples in other blocks: two
/// meshes in one camera view show nearly the same surface at nearly the same place, so that their
/// blocks are paired by place, and each rate is over its own samples. Where no block differs at
/// all, the interval is 0 to 0.
/// @throws InternalError as rateConfidence, or where they differ in number
ConfidenceInterval differenceConfidence(const BlockErrors& first, const BlockErrors& second,
                                        const Tiling& tiling,
                                        const Bootstrap& bootstrap = Bootstrap());

}  // namespace gnomon
