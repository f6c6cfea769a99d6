#include "compare/answer_groups.h"

#include <utility>

#include "compare/mask_checks.h"

namespace gnomon::compare {
namespace {

bool answersWhereverTruthDoes(const Mask& candidate, const Mask& truth) {
  std::size_t left = 0;  // counted without a branch, so that many are looked at at once
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const bool isLeft = !isAnswer(candidate.samples[i]) & isAnswer(truth.samples[i]);
    left += static_cast<std::size_t>(isLeft);
  }
  return left == 0;
}

}  // namespace

std::vector<std::vector<std::size_t>> answerGroups(std::span<const Mask* const> candidates,
                                                   const Mask& truth) {
  std::vector<std::vector<std::size_t>> groups;
  std::vector<std::size_t> together;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    requireSameView(*candidates[c], truth);
    if (!answersWhereverTruthDoes(*candidates[c], truth)) {
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
