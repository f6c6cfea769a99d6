#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "common/mask.h"
#include "compare/metric.h"

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

/// How many samples of each class have each pair of answers: what sums of weight 1 are made of, in
/// a fraction of their time.
class MaskTally {
 public:
  /// @param classes  one a sample; empty for class 0 everywhere. The masks are of one size.
  MaskTally(const Mask& candidate, const Mask& truth, std::span<const std::uint8_t> classes)
      : pairs_(classCount) {
    const auto add = [&](std::size_t i, std::uint64_t samples) {
      const std::size_t ofClass = classes.empty() ? 0 : classes[i];
      pairs_[ofClass][4 * placeOf(candidate.samples[i]) + placeOf(truth.samples[i])] += samples;
    };
    const std::size_t count = truth.size();
    std::size_t i = 0;
    for (; i + wordSize <= count; i += wordSize) {
      // Neighbours are mostly alike: then a word of them is counted at once.
      const bool isOneClass = classes.empty() || areAlike(&classes[i]);
      if (isOneClass && areAlike(&candidate.samples[i]) && areAlike(&truth.samples[i])) {
        add(i, wordSize);
      } else {
        for (std::size_t k = i; k < i + wordSize; ++k) add(k, 1);
      }
    }
    for (; i < count; ++i) add(i, 1);
  }

  /// Whether every sample of a class is in both masks or in neither.
  [[nodiscard]] bool agreesOnSamples(std::size_t ofClass) const {
    const std::uint64_t neither = count(ofClass, Shade::none, Shade::none);
    return counts(ofClass).samples + neither == samples(ofClass);
  }

  /// Of the samples of a class that are in both masks.
  [[nodiscard]] Counts counts(std::size_t ofClass) const {
    Counts counts;
    for (const Shade ours : {Shade::lit, Shade::shadowed}) {
      for (const Shade theirs : {Shade::lit, Shade::shadowed}) {
        const std::uint64_t samples = count(ofClass, ours, theirs);
        counts.cell(ours, theirs) = static_cast<double>(samples);
        counts.samples += samples;
      }
    }
    return counts;
  }

  /// All samples of a class.
  [[nodiscard]] std::uint64_t samples(std::size_t ofClass) const {
    std::uint64_t sum = 0;
    for (const std::uint64_t some : pairs_[ofClass]) sum += some;
    return sum;
  }

  static constexpr std::size_t classCount = 256;

 private:
  static constexpr std::size_t wordSize = sizeof(std::uint64_t);

  /// Whether a word's bytes are the same.
  static bool areAlike(const void* bytes) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes, wordSize);
    return word == (word & 0xff) * 0x0101010101010101;
  }

  /// 3 for what is no shade.
  static std::size_t placeOf(Shade shade) {
    return std::min<std::size_t>(static_cast<std::size_t>(shade), 3);
  }

  /// [4 candidate + truth]
  using Pairs = std::array<std::uint64_t, 16>;

  [[nodiscard]] std::uint64_t count(std::size_t ofClass, Shade candidate, Shade truth) const {
    return pairs_[ofClass][4 * placeOf(candidate) + placeOf(truth)];
  }

  std::vector<Pairs> pairs_;
};

/// All rates of one comparison, in this order:
///   error_rate    (FP + FN) / all
///   false_shadow  FP / all
///   false_light   FN / all                  (the two add up to error_rate)
///   fpr           FP / (FP + TN)            undefined where the truth has no lit sample
///   fnr           FN / (FN + TP)            undefined where the truth has no shadow
///   ber           (fpr + fnr) / 2           balanced error rate
///   iou           TP / (TP + FP + FN)       of the shadows; undefined where neither has any
///   f1            2 TP / (2 TP + FP + FN)
///   mcc           (TP TN - FP FN) / √((TP+FP)(TP+FN)(TN+FP)(TN+FN))  Matthews correlation
///   prevalence    (TP + FN) / all           share of shadow in the truth
/// f1 is undefined where iou is, and f1 = 2 iou / (1 + iou); ber where fpr or fnr is; mcc where
/// either mask is all lit or all shadowed. Nothing is defined without samples or without area.
/// @throws InternalError if a cell is negative or not finite
std::vector<Metric> rates(const Counts& counts);

/// One of them.
/// @throws InternalError for a metric of another kind
Metric rate(const Counts& counts, MetricId id);

/// The bin of a sample that has none.
constexpr std::uint8_t noBin = 255;

/// @throws InternalError for `noBin` edges or more, or edges that do not rise
void requireEdges(std::span<const double> edges);

/// The bin that holds a value: n edges, in rising order, make n + 1 bins, of which each holds its
/// lower edge but not its upper one. Bin 0 is what lies below all edges, bin n what lies at the
/// last or beyond, infinity too.
/// @param edges  as requireEdges
/// @returns 0 to n, or `noBin` for NaN: a sample without that value
std::uint8_t binOf(double value, std::span<const double> edges);
/// The counts of each bin: countSamples of the samples whose bin it is. They add up to those of all
/// samples that have a bin.
/// @param bins      one a sample, each below `binCount` or `noBin`
/// @param weights   one a sample, or empty for 1 each
/// @throws InputError if sizes differ, or a sample that has a bin is in one mask alone;
///   InternalError for a bin out of range
std::vector<Counts> countBins(const Mask& candidate, const Mask& truth,
                              std::span<const std::uint8_t> bins, std::size_t binCount,
                              std::span<const double> weights = {});
std::vector<Counts> countBins(const Visibility& candidate, const Visibility& truth,
                              std::span<const std::uint8_t> bins, std::size_t binCount,
                              std::span<const double> weights = {});

}  // namespace gnomon::compare
