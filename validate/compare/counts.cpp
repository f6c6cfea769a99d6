#include "compare/counts.h"

#include <fmt/core.h>

#include <cmath>

#include "common/error.h"
#include "compare/mask_checks.h"

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

[[noreturn]] void refusePair(const Mask& mask, std::size_t i, Shade candidate, Shade truth) {
  const auto width = static_cast<std::size_t>(mask.width);
  throw InputError(fmt::format(
      "masks differ in where they have samples: column {}, row {} is {} in the candidate and {} in "
      "the truth (0 lit, 1 shadowed, 2 none), both or neither expected",
      i % width, i / width, static_cast<int>(candidate), static_cast<int>(truth)));
}

/// The counts of each of some classes.
/// @param classOf  `classOf(i)` is a sample's class; one of `classCount` and more takes no part
template <typename ClassOf>
std::vector<Counts> countSums(const Mask& candidate, const Mask& truth,
                              std::span<const double> weights, std::size_t classCount,
                              const ClassOf& classOf) {
  requireSameView(candidate, truth);
  requireOnePerSample(weights.size(), truth.size(), "weights");
  requireWeights(weights);
  const auto width = static_cast<std::size_t>(truth.width);
  std::vector<Counts> sums(classCount);
  // Row sums first: the rounding error then grows with the sides of a mask, not with its area.
  for (std::size_t begin = 0; begin < truth.size(); begin += width) {
    std::vector<Counts> rows(classCount);
    for (std::size_t i = begin; i < begin + width; ++i) {
      const std::size_t own = classOf(i);
      if (own >= classCount) continue;
      const Shade ours = candidate.samples[i];
      const Shade theirs = truth.samples[i];
      if (ours == Shade::none && theirs == Shade::none) continue;
      if (!isAnswer(ours) || !isAnswer(theirs)) refusePair(truth, i, ours, theirs);
      rows[own].cell(ours, theirs) += weights.empty() ? 1.0 : weights[i];
      ++rows[own].samples;
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
  requireOnePerSample(selected.size(), truth.size(), "selection");
  return countSums(candidate, truth, weights, 1,
                   [&](std::size_t i) -> std::size_t {
                     return selected.empty() || selected[i] != 0 ? 0 : 1;
                   })
      .front();
}

std::vector<Counts> countClasses(const Mask& candidate, const Mask& truth,
                                 std::span<const std::uint8_t> classes, std::size_t classCount,
                                 std::span<const double> weights) {
  if (classes.size() != truth.size()) {
    throw InputError(fmt::format("classes: {} found for {} samples, one each expected",
                                 classes.size(), truth.size()));
  }
  return countSums(candidate, truth, weights, classCount,
                   [&](std::size_t i) -> std::size_t { return classes[i]; });
}

}  // namespace gnomon::compare
