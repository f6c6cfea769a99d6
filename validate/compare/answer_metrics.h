#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/mask.h"
#include "compare/confidence_interval.h"
#include "compare/counts.h"
#include "compare/shadow_length.h"

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

/// Whether a sample has an answer: lit or shadowed.
inline bool isAnswer(Shade shade) {
  return shade == Shade::lit || shade == Shade::shadowed;
}

/// Whether a mask has an answer wherever the truth has one. Both are of one size.
bool answersAllOf(const Mask& truth, const Mask& candidate);

/// @throws InputError unless both masks hold what their widths and heights promise and are of one
///   size
void requireSameView(const Mask& candidate, const Mask& truth);

/// The same of maps of visibility.
void requireSameView(const Visibility& candidate, const Visibility& truth);

/// @throws InputError unless there is one value a sample, or none at all
void requireOnePerSample(std::size_t found, std::size_t samples, const char* what);

/// How the samples of a view lie beside each other. As it stands: an image, measured in pixels.
struct SampleLayout {
  double columnStep = 1;  ///< from a column to the next, in the view's unit: pixels or texels
  double rowStep = 1;     ///< from a row to the next, in that unit
  /// Side, in samples, of the square tiles of an atlas in which neighbours in the picture are none
  /// on the surface, once they are in different tiles. 0 where there are none.
  int tileSide = 0;
  /// One a sample: the neighbours from which a break in the surface parts it, as at the contour of
  /// a fold. A sum of `breakRight` and `breakBelow`. Empty where the surface has none.
  std::vector<std::uint8_t> breaks;
};

constexpr std::uint8_t breakRight = 1;  ///< between a sample and the one to its right
constexpr std::uint8_t breakBelow = 2;  ///< between a sample and the one below

/// Where V is below this a sample lies in umbra, where it is above 1 less this it sees the whole
/// disc: half a ray of the truth's 256.
constexpr double umbraTolerance = 1.0 / 512;
/// The penumbra whose width is measured runs from one of these shares to the other.
constexpr double penumbraBegin = 0.1;
constexpr double penumbraEnd = 0.9;

/// How two maps of visibility differ, over the samples that both hold, by weight w; in this order:
///
///   mae                   Σ w |ΔV| / Σ w, ΔV = V - V_truth: `error_rate` of their `Counts`
///   rmse                  √(Σ w ΔV² / Σ w)
///   off_by_more_than_0.1  the share of the weight where |ΔV| > 0.1
///   umbra_iou             weight where both are below `umbraTolerance` over that where one is;
///                         undefined where neither is anywhere
///   penumbra_iou          likewise where V is from that tolerance to 1 less that
///
/// On maps of 0 and 1 mae, rmse² and off_by_more_than_0.1 are the masks' error rate.
/// @param weights  one a sample, or empty for 1 each
/// @throws InputError as `countSamples` of two maps
std::vector<Metric> shareMetrics(const Visibility& candidate, const Visibility& truth,
                                 std::span<const double> weights = {});

/// Where a map is in the penumbra whose width is measured, `penumbraBegin` < V < `penumbraEnd`, as
/// a mask: there shadowed, elsewhere lit.
Mask penumbraMask(const Visibility& map);

/// The widths of penumbrae along the light, the candidate's over the truth's:
/// `compareShadowLengths` of their penumbra masks, over all samples, as metrics:
///   penumbra_width_ratio  the median: 1 as wide as the truth's, 0 a hard edge
///   penumbra_width_q1     lower quartile
///   penumbra_width_q3     upper quartile
///   penumbra_runs         width of all penumbrae measured, in samples across the light
/// A penumbra narrower than `leastRunSamples` samples is not measured.
std::vector<Metric> penumbraMetrics(const ShadowLengths& widths);

/// All reasons why one of them has no value.
const std::vector<std::string_view>& shareReasons();

}  // namespace gnomon::compare
