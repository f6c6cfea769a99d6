#include "compare/counts.h"

#include <fmt/core.h>

#include <cmath>
#include <functional>
#include <optional>

#include "common/error.h"
#include "compare/answer_metrics.h"
#include "compare/answer_pair.h"

namespace gnomon::compare {

namespace {

void requireWeights(std::span<const double> weights) {
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!(weights[i] >= 0 && std::isfinite(weights[i]))) {
      throw InputError(fmt::format(
          "weights: sample {} has weight {}, a finite one of at least 0 expected", i, weights[i]));
    }
  }
}

/// The counts of each of some classes.
/// @param pair     see answer_pair.h
/// @param classOf  `classOf(i)` is a sample's class; one of `classCount` and more takes no part
template <typename Pair, typename ClassOf>
std::vector<Counts> countSums(const Pair& pair, std::span<const double> weights,
                              std::size_t classCount, const ClassOf& classOf) {
  requireOnePerSample(weights.size(), pair.size(), "weights");
  requireWeights(weights);
  const auto width = static_cast<std::size_t>(pair.width());
  std::vector<Counts> sums(classCount);
  // Row sums first: the rounding error then grows with the sides of a mask, not with its area.
  for (std::size_t begin = 0; begin < pair.size(); begin += width) {
    std::vector<Counts> rows(classCount);
    for (std::size_t i = begin; i < begin + width; ++i) {
      const std::size_t own = classOf(i);
      if (own >= classCount) continue;
      if (pair.hasNeither(i)) continue;
      if (!pair.hasBoth(i)) pair.refuse(i);
      pair.add(i, weights.empty() ? 1.0 : weights[i], rows[own]);
    }
    for (std::size_t c = 0; c < classCount; ++c) sums[c] += rows[c];
  }
  for (const Counts& sum : sums) {
    if (!std::isfinite(sum.total())) {
      throw InputError("weights: their sum is larger than a double holds");
    }
  }
  return sums;
}

/// The same of masks whose samples all weigh 1; none where a sample of a class that takes part is
/// in one of them only.
std::optional<std::vector<Counts>> talliedCounts(const Mask& candidate, const Mask& truth,
                                                 std::span<const std::uint8_t> classes,
                                                 std::size_t classCount) {
  requireSameView(candidate, truth);
  const MaskTally tally(candidate, truth, classes);
  const std::size_t known = std::min(classCount, MaskTally::classCount);
  std::vector<Counts> counts(classCount);
  for (std::size_t c = 0; c < known; ++c) {
    if (!tally.agreesOnSamples(c)) return std::nullopt;
    counts[c] = tally.counts(c);
  }
  return counts;
}

template <typename Pair>
Counts countSelected(const Pair& pair, std::span<const double> weights,
                     std::span<const std::uint8_t> selected) {
  requireOnePerSample(selected.size(), pair.size(), "selection");
  return countSums(pair, weights, 1,
                   [&](std::size_t i) -> std::size_t {
                     return selected.empty() || selected[i] != 0 ? 0 : 1;
                   })
      .front();
}

template <typename Pair>
std::vector<Counts> countEach(const Pair& pair, std::span<const std::uint8_t> classes,
                              std::size_t classCount, std::span<const double> weights) {
  if (classes.size() != pair.size()) {
    throw InputError(fmt::format("classes: {} found for {} samples, one each expected",
                                 classes.size(), pair.size()));
  }
  return countSums(pair, weights, classCount,
                   [&](std::size_t i) -> std::size_t { return classes[i]; });
}

}  // namespace

double& Counts::cell(Shade candidate, Shade truth) {
  if (truth == Shade::shadowed) {
    return candidate == Shade::shadowed ? truePositive : falseNegative;
  }
  return candidate == Shade::shadowed ? falsePositive : trueNegative;
}

Counts& Counts::operator+=(const Counts& other) {
  truePositive += other.truePositive;
  falsePositive += other.falsePositive;
  falseNegative += other.falseNegative;
  trueNegative += other.trueNegative;
  samples += other.samples;
  return *this;
}

Counts countSamples(const Mask& candidate, const Mask& truth, std::span<const double> weights,
                    std::span<const std::uint8_t> selected) {
  if (weights.empty() && selected.empty()) {
    const auto counts = talliedCounts(candidate, truth, {}, 1);
    if (counts) return counts->front();
  }
  return countSelected(MaskPair(candidate, truth), weights, selected);
}

Counts countSamples(const Visibility& candidate, const Visibility& truth,
                    std::span<const double> weights, std::span<const std::uint8_t> selected) {
  return countSelected(SharePair(candidate, truth), weights, selected);
}

std::vector<Counts> countClasses(const Mask& candidate, const Mask& truth,
                                 std::span<const std::uint8_t> classes, std::size_t classCount,
                                 std::span<const double> weights) {
  if (weights.empty() && classes.size() == truth.size() && !classes.empty()) {
    const auto counts = talliedCounts(candidate, truth, classes, classCount);
    if (counts) return *counts;
  }
  return countEach(MaskPair(candidate, truth), classes, classCount, weights);
}

std::vector<Counts> countClasses(const Visibility& candidate, const Visibility& truth,
                                 std::span<const std::uint8_t> classes, std::size_t classCount,
                                 std::span<const double> weights) {
  return countEach(SharePair(candidate, truth), classes, classCount, weights);
}

namespace {

/// A metric's value, or the reason why it has none.
struct Figure {
  std::optional<double> value;
  std::string_view reason;
};

Figure defined(double value) {
  return {value, {}};
}

Figure undefined(std::string_view reason) {
  return {std::nullopt, reason};
}

/// Why no metric at all is defined, or empty.
std::string_view emptiness(const Counts& c) {
  if (c.samples == 0) return "no samples";
  if (c.total() == 0) return "the samples have no area";
  return {};
}

Figure share(double part, const Counts& c) {
  const std::string_view reason = emptiness(c);
  return reason.empty() ? defined(part / c.total()) : undefined(reason);
}

Figure errorRate(const Counts& c) {
  return share(c.falsePositive + c.falseNegative, c);
}

Figure falseShadow(const Counts& c) {
  return share(c.falsePositive, c);
}

Figure falseLight(const Counts& c) {
  return share(c.falseNegative, c);
}

Figure prevalence(const Counts& c) {
  return share(c.truePositive + c.falseNegative, c);
}

/// part / whole, undefined for the given reason where the whole is empty.
Figure ratio(double part, double whole, const Counts& c, std::string_view reason) {
  if (whole > 0) return defined(part / whole);
  const std::string_view empty = emptiness(c);
  return undefined(empty.empty() ? reason : empty);
}

Figure fpr(const Counts& c) {
  return ratio(c.falsePositive, c.falsePositive + c.trueNegative, c, "the truth has no lit sample");
}

Figure fnr(const Counts& c) {
  return ratio(c.falseNegative, c.falseNegative + c.truePositive, c, "the truth has no shadow");
}

Figure ber(const Counts& c) {
  const Figure ofLit = fpr(c);
  const Figure ofShadow = fnr(c);
  if (!ofLit.value) return ofLit;
  if (!ofShadow.value) return ofShadow;
  return defined((*ofLit.value + *ofShadow.value) / 2);
}

constexpr std::string_view noShadow = "neither the truth nor the candidate has a shadow";

Figure iou(const Counts& c) {
  return ratio(c.truePositive, c.truePositive + c.falsePositive + c.falseNegative, c, noShadow);
}

Figure f1(const Counts& c) {
  // The mean of both masks' shadow: half the usual denominator, which could overflow.
  const double meanShadow = c.truePositive + (c.falsePositive + c.falseNegative) / 2;
  return ratio(c.truePositive, meanShadow, c, noShadow);
}

/// Exact for equal arguments, and free of the overflow and underflow of a product.
double geometricMean(double a, double b) {
  return a == b ? a : std::sqrt(a) * std::sqrt(b);
}

Figure mcc(const Counts& c) {
  const double candidateShadow = c.truePositive + c.falsePositive;
  const double truthShadow = c.truePositive + c.falseNegative;
  const double truthLit = c.trueNegative + c.falsePositive;
  const double candidateLit = c.trueNegative + c.falseNegative;
  const std::string_view empty = emptiness(c);
  if (!empty.empty()) return undefined(empty);
  if (truthLit == 0) return undefined("the truth has no lit sample");
  if (truthShadow == 0) return undefined("the truth has no shadow");
  if (candidateLit == 0) return undefined("the candidate has no lit sample");
  if (candidateShadow == 0) return undefined("the candidate has no shadow");
  // The usual quotient, split so that every factor lies between 0 and 1.
  const double agreement = c.truePositive / geometricMean(candidateShadow, truthShadow) *
                           (c.trueNegative / geometricMean(truthLit, candidateLit));
  const double disagreement = c.falsePositive / geometricMean(candidateShadow, truthLit) *
                              (c.falseNegative / geometricMean(truthShadow, candidateLit));
  return defined(std::clamp(agreement - disagreement, -1.0, 1.0));
}

struct Rate {
  MetricId id;
  Figure (*formula)(const Counts&);

  [[nodiscard]] Metric of(const Counts& counts) const {
    const auto [value, reason] = formula(counts);
    return {id, value, reason};
  }
};

constexpr std::array<Rate, 10> allRates = {{{"error_rate", errorRate},
                                            {"false_shadow", falseShadow},
                                            {"false_light", falseLight},
                                            {"fpr", fpr},
                                            {"fnr", fnr},
                                            {"ber", ber},
                                            {"iou", iou},
                                            {"f1", f1},
                                            {"mcc", mcc},
                                            {"prevalence", prevalence}}};

void requireSound(const Counts& c) {
  const std::array cells = {c.truePositive, c.falsePositive, c.falseNegative, c.trueNegative};
  const bool negative = std::any_of(cells.begin(), cells.end(), [](double x) { return !(x >= 0); });
  if (negative || !std::isfinite(c.total())) {
    throw InternalError(
        fmt::format("counts: tp {}, fp {}, fn {}, tn {}: finite cells of at least 0 expected",
                    cells[0], cells[1], cells[2], cells[3]));
  }
}

}  // namespace

std::vector<Metric> rates(const Counts& counts) {
  requireSound(counts);
  std::vector<Metric> metrics;
  metrics.reserve(allRates.size());
  for (const Rate& rate : allRates) metrics.push_back(rate.of(counts));
  return metrics;
}

Metric rate(const Counts& counts, MetricId id) {
  requireSound(counts);
  for (const Rate& rate : allRates) {
    if (rate.id == id) return rate.of(counts);
  }
  throw InternalError(fmt::format("metric: \"{}\" is not one that rates() has", id.name()));
}

namespace {

void requireBin(std::uint8_t bin, std::size_t binCount) {
  if (bin < binCount) return;
  throw InternalError(fmt::format("bin {} found, below {} expected", bin, binCount));
}

void requireBins(std::span<const std::uint8_t> bins, std::size_t binCount) {
  // Without a branch and in bytes, so that many are looked at at once.
  const auto most = static_cast<std::uint8_t>(std::min<std::size_t>(binCount, noBin));
  std::uint8_t bad = 0;
  for (const std::uint8_t bin : bins) {
    bad = static_cast<std::uint8_t>(bad | ((bin >= most) & (bin != noBin)));
  }
  if (bad == 0) return;
  for (const std::uint8_t bin : bins) {
    if (bin != noBin) requireBin(bin, binCount);
  }
}

template <typename Pair>
std::vector<Counts> countEachBin(const Pair& pair, std::span<const std::uint8_t> bins,
                                 std::size_t binCount, std::span<const double> weights) {
  requireOnePerSample(weights.size(), pair.size(), "weight");
  if (bins.size() != pair.size()) {
    throw InputError(
        fmt::format("bins: {} found for {} samples, one each expected", bins.size(), pair.size()));
  }
  std::vector<Counts> counts(binCount);
  for (std::size_t i = 0; i < pair.size(); ++i) {
    if (bins[i] == noBin) continue;
    requireBin(bins[i], binCount);
    if (pair.hasNeither(i)) continue;
    if (!pair.hasBoth(i)) {
      throw InputError(fmt::format("sample {}: in one of the masks only", i));
    }
    pair.add(i, weights.empty() ? 1 : weights[i], counts[bins[i]]);
  }
  return counts;
}

}  // namespace

void requireEdges(std::span<const double> edges) {
  const bool rise =
      std::adjacent_find(edges.begin(), edges.end(), std::greater_equal<>()) == edges.end();
  if (edges.size() < noBin && rise) return;
  throw InternalError(
      fmt::format("{} edges found, fewer than {} that rise expected", edges.size(), noBin));
}

std::uint8_t binOf(double value, std::span<const double> edges) {
  if (std::isnan(value)) return noBin;
  const auto above = std::upper_bound(edges.begin(), edges.end(), value);
  return static_cast<std::uint8_t>(above - edges.begin());
}

std::vector<Counts> countBins(const Mask& candidate, const Mask& truth,
                              std::span<const std::uint8_t> bins, std::size_t binCount,
                              std::span<const double> weights) {
  if (!weights.empty()) return countEachBin(MaskPair(candidate, truth), bins, binCount, weights);
  requireBins(bins, binCount);
  return countClasses(candidate, truth, bins, binCount);  // at most noBin, which is thus no class
}

std::vector<Counts> countBins(const Visibility& candidate, const Visibility& truth,
                              std::span<const std::uint8_t> bins, std::size_t binCount,
                              std::span<const double> weights) {
  return countEachBin(SharePair(candidate, truth), bins, binCount, weights);
}

}  // namespace gnomon::compare
