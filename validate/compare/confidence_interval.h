#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "common/mask.h"

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

/// A confidence interval, both ends included.
struct Interval {
  double low = 0;
  double high = 0;

  /// Whether it holds a number.
  [[nodiscard]] bool holds(double value) const { return low <= value && value <= high; }
};

/// Confidence intervals of error rates, and of their differences, from the masks of one view.
///
/// *What an interval speaks of.* In 95 of 100 cases it holds the error rate that the method has on
/// average over all draws of the relief's bumps, on the same surface, in the same view, under the
/// same lights. Surface, view and lights are settings of the study; the bumps are the sample.
///
/// *Blocks.* Neighbouring samples err together, so a view is cut into square blocks, at least
/// `leastBlocks` of equal weight. A block keeps all lights, which are summed.
///
/// *The error drifts, bumps do not.* How often a method errs changes smoothly over the view: with
/// the distance to the terminator, the light's elevation, the curvature. That drift is the same for
/// every draw of the bumps, so it must not count as spread. Every 2 × 2 blocks side by side, of
/// rates r (of a difference: first less second) and shares p of the view's weight, give
///   c = r₀₀ - r₁₀ - r₀₁ + r₁₁,   t = c² / Σ (1 / p):
/// c is free of every drift f(x) + g(y), and t estimates the variance of the whole view's rate from
/// the bumps of four blocks alone (Rice 1984 and Gasser et al. 1986 for curves; Hall, Kay &
/// Titterington 1991 for images). With T = t Σ p, the variance is s² = Σ T / Σ Σ p.
///
/// *Degrees of freedom.* ν = (Σ T)² / (2 Σ T²): Satterthwaite (1946) with a T's variance taken as
/// E T², its upper bound, and a fourth as many independent ones as there are, since a block lies in
/// four. A few blocks with nearly all errors thus give few degrees. The interval is
/// rate ± t₉₇.₅(ν) s by Student's t, cut to the range of a rate or of a difference.
///
/// *What neighbours share.* A bump that a block's border cuts lies in two blocks, so that s is too
/// small by a share that falls as 1 / side. From blocks of side b and of b / 2, its cells,
/// 2 s(b) - s(b/2) is free of that (Politis & Romano 1995 for series). The correction's own noise
/// is kept at bay: s is multiplied by 2 - s(b/2) / s(b), but by 1 to `largestCorrection`.
///
/// *A difference that few blocks hold* (ν < `leastDegrees`, or fewer than `leastWrongBlocks` that
/// differ) has the interval of the random signs (Fisher 1935; Pitman 1937): if two methods are
/// equally good, a block's part of the difference, x = firstWrong / Σ firstWeight - secondWrong /
/// Σ secondWeight, might as well have the other sign. Of 1,999 choices of all signs, the same on
/// every machine, 5 in 100 have a |Σ ± x| of h or more: the interval is the difference ± h. It
/// leaves 0 out just where p = (1 + number of choices that reach |Σ x|) / 2,000 is no more than
/// 0.05, so that five blocks never do. h is corrected for what neighbours share as s is, by √Σ x²
/// of blocks and of cells. A drift counts as spread: the interval is rather too wide.
///
/// *Checked* by simulation (tests/compare/confidence_coverage_test.cpp) with and without drift, and
/// against new draws of the bumps (tests/end_to_end/redrawn_bumps_test.cpp). It is too narrow where
/// bumps larger than a sixteenth of the view's side lie at random, and too wide, by a factor of 2
/// or so, where the errors form a regular lattice or pile up at one sharp place.
struct ConfidenceInterval {
  std::optional<Interval> interval;  ///< none where too little is known
  std::string_view reason;           ///< why there is none; empty if there is one
  std::size_t blocks = 0;            ///< that hold a sample
  bool areEqual = false;             ///< of a difference: both answer alike, to the sample
};

/// Fewer blocks than this give no interval.
constexpr std::size_t leastBlocks = 144;
/// Fewer blocks than this in which anything deviates from none at all give no interval of a rate.
constexpr std::size_t leastWrongBlocks = 6;
/// Fewer degrees of freedom than this give no interval of a rate: one or two blocks decide
/// everything.
constexpr double leastDegrees = 3;
/// Of the standard error, for what neighbouring blocks share.
constexpr double largestCorrection = 1.5;

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

/// The 95 % interval of an error rate, within 0 to 1.
/// @param cells  blockErrors of side `tiling.cellSide`, summed over lights
/// @throws InternalError where cells do not fill the tiling's columns
ConfidenceInterval rateConfidence(const BlockErrors& cells, const Tiling& tiling);

/// The 95 % interval of first.rate() - second.rate(), within -1 to 1. Blocks are compared by place,
/// so that what both get wrong cancels. Both may have other weights, or samples in other blocks:
/// two meshes in one camera view show nearly the same surface at nearly the same place, and each
/// rate is over its own samples. None of equal answers, where the view has too few blocks, and
/// where no block differs.
/// @throws InternalError as rateConfidence, or where they differ in number
ConfidenceInterval differenceConfidence(const BlockErrors& first, const BlockErrors& second,
                                        const Tiling& tiling);

/// What a number of Student's distribution exceeds with a probability of 2.5 %, by the expansion
/// around the normal quantile (Abramowitz & Stegun 26.7.5); right to a hundredth of itself.
/// @param degrees  of freedom, `leastDegrees` or more; need not be whole
double studentQuantile(double degrees);

}  // namespace gnomon::compare
