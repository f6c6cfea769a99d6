#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
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

}  // namespace gnomon::compare
