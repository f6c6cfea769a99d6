#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "compare/counts.h"

namespace gnomon::compare {

/// How many samples of each class have each pair of answers: what sums of weight 1 are made of, in
/// a fraction of their time.
class MaskTally {
 public:
  /// @param classes  one a sample; empty for class 0 everywhere. The masks are of one size.
  MaskTally(const Mask& candidate, const Mask& truth, std::span<const std::uint8_t> classes)
      : pairs_(classCount) {
    const auto pairOf = [&](std::size_t i) {
      return 4 * placeOf(candidate.samples[i]) + placeOf(truth.samples[i]);
    };
    const auto tally = [&](const auto& classOf) {
      // Sums take turns: neighbours mostly have the same pair, and would wait for each other.
      constexpr std::size_t turns = 4;
      std::array<std::vector<Pairs>, turns> sums;
      sums.fill(std::vector<Pairs>(classCount));
      std::size_t i = 0;
      for (; i + turns <= truth.size(); i += turns) {
        for (std::size_t t = 0; t < turns; ++t) ++sums[t][classOf(i + t)][pairOf(i + t)];
      }
      for (; i < truth.size(); ++i) ++sums[0][classOf(i)][pairOf(i)];
      for (const std::vector<Pairs>& sum : sums) {
        for (std::size_t c = 0; c < classCount; ++c) {
          for (std::size_t p = 0; p < sum[c].size(); ++p) pairs_[c][p] += sum[c][p];
        }
      }
    };
    if (classes.empty()) {
      tally([](std::size_t) { return std::size_t{0}; });
    } else {
      tally([&](std::size_t i) { return std::size_t{classes[i]}; });
    }
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

}  // namespace gnomon::compare
