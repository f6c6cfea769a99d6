#include "compare/counts.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/error.h"
#include "compare/answer_pair.h"
#include "compare/mask_checks.h"
#include "compare/mask_tally.h"

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

}  // namespace gnomon::compare
