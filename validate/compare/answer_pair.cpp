#include "compare/answer_pair.h"

#include <utility>

namespace gnomon::compare {

std::vector<std::vector<std::size_t>> answerGroups(std::span<const Mask* const> candidates,
                                                   const Mask& truth) {
  std::vector<std::vector<std::size_t>> groups;
  std::vector<std::size_t> together;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    requireSameView(*candidates[c], truth);
    if (!answersAllOf(truth, *candidates[c])) {
      groups.push_back({c});
      continue;
    }
    together.push_back(c);
    if (together.size() == mostCandidatesAtOnce) groups.push_back(std::exchange(together, {}));
  }
  if (!together.empty()) groups.push_back(std::move(together));
  return groups;
}

}  // namespace gnomon::compare
