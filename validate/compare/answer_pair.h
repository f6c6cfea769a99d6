#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/error.h"
#include "common/mask.h"
#include "compare/answer_metrics.h"
#include "compare/counts.h"

namespace gnomon::compare {

/// A candidate and the truth as sums take them, sample by sample: two masks, or two maps of
/// visibility. Both kinds have
///
///   hasBoth(i)     both have an answer
///   hasNeither(i)  none has
///   wrong(i)       how far they differ, 0 to 1
///   answerBits(i)  the candidate's answer, as it is stored
///   add(i, w, c)   adds a sample of weight w to the cells of c
class MaskPair {
 public:
  /// @throws InputError as requireSameView
  MaskPair(const Mask& candidate, const Mask& truth) : candidate_(candidate), truth_(truth) {
    requireSameView(candidate, truth);
  }

  [[nodiscard]] int width() const { return truth_.width; }
  [[nodiscard]] int height() const { return truth_.height; }
  [[nodiscard]] std::size_t size() const { return truth_.size(); }
  [[nodiscard]] bool hasBoth(std::size_t i) const {
    return isAnswer(candidate_.samples[i]) && isAnswer(truth_.samples[i]);
  }
  [[nodiscard]] bool hasNeither(std::size_t i) const {
    return candidate_.samples[i] == Shade::none && truth_.samples[i] == Shade::none;
  }
  [[nodiscard]] double wrong(std::size_t i) const {
    return candidate_.samples[i] != truth_.samples[i] ? 1 : 0;
  }
  [[nodiscard]] std::uint64_t answerBits(std::size_t i) const {
    return static_cast<std::uint64_t>(candidate_.samples[i]);
  }
  void add(std::size_t i, double weight, Counts& counts) const {
    counts.cell(candidate_.samples[i], truth_.samples[i]) += weight;
    ++counts.samples;
  }
  [[noreturn]] void refuse(std::size_t i) const {
    const auto columns = static_cast<std::size_t>(truth_.width);
    throw InputError(fmt::format(
        "masks differ in where they have samples: column {}, row {} is {} in the candidate and {} "
        "in the truth (0 lit, 1 shadowed, 2 none), both or neither expected",
        i % columns, i / columns, static_cast<int>(candidate_.samples[i]),
        static_cast<int>(truth_.samples[i])));
  }

 private:
  const Mask& candidate_;
  const Mask& truth_;
};

/// Two maps of visibility. A sample is divided among the four cells, by the shadow shares S = 1 -
/// V:
///
///   true positive   min(S, S_truth)          false positive  max(0, S - S_truth)
///   true negative   min(V, V_truth)          false negative  max(0, S_truth - S)
///
/// They add up to the sample's weight, and where both shares are 0 or 1 they are a mask's.
class SharePair {
 public:
  /// @throws InputError as requireSameView, and for a share outside 0 to 1
  SharePair(const Visibility& candidate, const Visibility& truth)
      : candidate_(candidate), truth_(truth) {
    requireSameView(candidate, truth);
    requireShares(candidate, "candidate");
    requireShares(truth, "truth");
  }

  [[nodiscard]] int width() const { return truth_.width; }
  [[nodiscard]] int height() const { return truth_.height; }
  [[nodiscard]] std::size_t size() const { return truth_.size(); }
  [[nodiscard]] bool hasBoth(std::size_t i) const {
    return !std::isnan(candidate_.shares[i]) && !std::isnan(truth_.shares[i]);
  }
  [[nodiscard]] bool hasNeither(std::size_t i) const {
    return std::isnan(candidate_.shares[i]) && std::isnan(truth_.shares[i]);
  }
  [[nodiscard]] double candidate(std::size_t i) const {
    return static_cast<double>(candidate_.shares[i]);
  }
  [[nodiscard]] double truth(std::size_t i) const { return static_cast<double>(truth_.shares[i]); }
  [[nodiscard]] double wrong(std::size_t i) const { return std::abs(candidate(i) - truth(i)); }
  [[nodiscard]] std::uint64_t answerBits(std::size_t i) const {
    return std::bit_cast<std::uint32_t>(candidate_.shares[i]);
  }
  void add(std::size_t i, double weight, Counts& counts) const {
    const double ours = candidate(i);
    const double theirs = truth(i);
    counts.truePositive += weight * (1 - std::max(ours, theirs));
    counts.falsePositive += weight * std::max(0.0, theirs - ours);
    counts.falseNegative += weight * std::max(0.0, ours - theirs);
    counts.trueNegative += weight * std::min(ours, theirs);
    ++counts.samples;
  }
  [[noreturn]] void refuse(std::size_t i) const {
    const auto columns = static_cast<std::size_t>(truth_.width);
    throw InputError(
        fmt::format("maps differ in where they have samples: column {}, row {} is {} in the "
                    "candidate and {} in the truth, both or neither expected",
                    i % columns, i / columns, candidate_.shares[i], truth_.shares[i]));
  }

 private:
  static void requireShares(const Visibility& map, const char* who) {
    const auto found = std::find_if(map.shares.begin(), map.shares.end(),
                                    [](float share) { return share < 0 || share > 1; });
    if (found == map.shares.end()) return;
    const auto i = static_cast<std::size_t>(found - map.shares.begin());
    const auto columns = static_cast<std::size_t>(map.width);
    throw InputError(fmt::format("{} map: {} at column {}, row {}, a share of 0 to 1 expected", who,
                                 *found, i % columns, i / columns));
  }

  const Visibility& candidate_;
  const Visibility& truth_;
};

/// Candidates are compared with one truth at once, up to so many: a word of 64 bits has one for
/// each, and some for the truth.
constexpr std::size_t mostCandidatesAtOnce = 60;

/// Sorts candidates into groups that have answers at the same of the truth's samples: what follows
/// from the truth alone is then the same for all of a group. Those with an answer wherever the
/// truth has one come together, any other stands alone. No group has more than
/// `mostCandidatesAtOnce`.
/// @returns places in `candidates`, each in one group
/// @throws InputError as requireSameView
std::vector<std::vector<std::size_t>> answerGroups(std::span<const Mask* const> candidates,
                                                   const Mask& truth);

/// Compares the candidates of each group at once.
/// @param compare  given some of the candidates, returns a result for each
/// @returns the results of all candidates, in their order
template <typename Compare>
auto compareInGroups(std::span<const Mask* const> candidates, const Mask& truth,
                     const Compare& compare) {
  using Results = decltype(compare(candidates));
  Results all(candidates.size());
  for (const std::vector<std::size_t>& group : answerGroups(candidates, truth)) {
    std::vector<const Mask*> some;
    some.reserve(group.size());
    for (const std::size_t place : group) some.push_back(candidates[place]);
    Results found = compare(std::span<const Mask* const>(some));
    for (std::size_t i = 0; i < group.size(); ++i) all[group[i]] = std::move(found[i]);
  }
  return all;
}

}  // namespace gnomon::compare
