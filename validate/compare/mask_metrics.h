#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/mask.h"
#include "common/visibility.h"
#include "compare/confidence_interval.h"
#include "compare/rates.h"

namespace gnomon::compare {

/// Two masks of one picture, with an answer in both or in neither.
struct ComparedMasks {
  Mask candidate, truth;
  /// Of pictures of visibility: the shares that the masks are cut from. Else empty.
  Visibility candidateShares = {}, truthShares = {};
  std::size_t compared = 0;       ///< pixels with an answer in both
  std::size_t withoutSample = 0;  ///< left out: the truth has no sample there
  std::size_t outsideRoi = 0;     ///< left out: the truth has one, but outside the region
};

/// Keeps what is to be compared: the pixels where the truth has a sample and, if there is one, the
/// region of interest is lit. All others become Shade::none in both.
/// @param roi  lit where pixels count; null for everywhere
/// @throws InputError where sizes differ, nothing is left, or the candidate has no sample at a
/// pixel
///   that counts (naming how many and the first): it must not choose what it is judged by
ComparedMasks commonPixels(Mask candidate, Mask truth, const Mask* roi);

/// The same of two maps of visibility; the masks are what they are cut to.
ComparedMasks commonPixels(const Visibility& candidate, const Visibility& truth, const Mask* roi);

/// The counts of the masks, or of the shares where there are any.
/// @param weights  one a sample, or empty for 1 each
Counts countsOf(const ComparedMasks& masks, std::span<const double> weights = {});

/// A notice that one of the two seems inverted: 95 % of the samples or more are wrong, and how many
/// would be if the candidate were its complement, "99.6 % of the samples are wrong, and the
/// complement would be 0.4 % wrong: is one of them inverted?".
/// @param weights  one a sample, or empty for 1 each
std::optional<std::string> invertedNotice(const ComparedMasks& masks,
                                          std::span<const double> weights = {});

/// All metrics that two masks alone give: their rates, every pixel counted alike, then their
/// boundaries, in pixels.
/// @throws as `countSamples` and `compareBoundaries`
std::vector<Metric> maskMetrics(const Mask& candidate, const Mask& truth);

/// The same of shares, where there are any: their rates, the boundaries of the masks that they are
/// cut to, then `shareMetrics`.
std::vector<Metric> maskMetrics(const ComparedMasks& masks);

/// The 95 % interval of the error rate, as a run gives it: of one picture, or of the mean over
/// several lights in one view.
/// @param lights   at least one
/// @param weights  one a sample, or empty for 1 each
/// @return none with a reason as `rateConfidence`, or where the pictures are of several views
/// @throws as `blockErrors`
ConfidenceInterval maskConfidence(std::span<const ComparedMasks> lights,
                                  std::span<const double> weights = {});

}  // namespace gnomon::compare
