#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "common/mask.h"

namespace gnomon::compare {

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
