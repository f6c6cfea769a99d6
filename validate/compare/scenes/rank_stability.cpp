#include "compare/scenes/rank_stability.h"

#include <algorithm>
#include <numeric>

namespace gnomon::compare {
namespace {

/// One a method.
std::vector<std::size_t> ranksOf(const std::vector<double>& sums) {
  std::vector<double> sorted = sums;
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::size_t> ranks;
  for (const double sum : sums) {
    const auto first = std::lower_bound(sorted.begin(), sorted.end(), sum);
    ranks.push_back(static_cast<std::size_t>(first - sorted.begin()) + 1);
  }
  return ranks;
}

/// The rank below which no more than a share of the resamples lies.
/// @param counts  of resamples, by rank
std::size_t rankAt(const std::vector<std::size_t>& counts, std::size_t skipped) {
  std::size_t passed = 0;
  for (std::size_t r = 0; r < counts.size(); ++r) {
    passed += counts[r];
    if (passed > skipped) return r + 1;
  }
  return counts.size();
}

}  // namespace

std::vector<SceneRank> ranksOver(const std::vector<std::vector<double>>& errors,
                                 const SceneResamples& resamples) {
  const std::size_t methods = errors.size();
  const std::size_t scenes = resamples.scenes();
  // One scene's errors side by side.
  std::vector<double> byScene(methods * scenes);
  for (std::size_t m = 0; m < methods; ++m) {
    for (std::size_t s = 0; s < scenes; ++s) byScene[s * methods + m] = errors[m].at(s);
  }
  const auto sumsOver = [&](const auto& drawn) {
    std::vector<double> sums(methods);
    for (const std::size_t s : drawn) {
      for (std::size_t m = 0; m < methods; ++m) sums[m] += byScene[s * methods + m];
    }
    return sums;
  };
  std::vector<std::uint32_t> all(scenes);
  std::iota(all.begin(), all.end(), 0U);
  const std::vector<std::size_t> own = ranksOf(sumsOver(all));
  std::vector<std::vector<std::size_t>> counts(methods, std::vector<std::size_t>(methods));
  std::vector<std::uint32_t> drawn(scenes);
  for (std::size_t b = 0; b < resamples.count(); ++b) {
    resamples.draw(b, drawn);
    const std::vector<std::size_t> ranks = ranksOf(sumsOver(drawn));
    for (std::size_t m = 0; m < methods; ++m) ++counts[m][ranks[m] - 1];
  }
  const std::size_t skipped = resamples.count() / 40;
  std::vector<SceneRank> ranked;
  for (std::size_t m = 0; m < methods; ++m) {
    SceneRank rank{own[m]};
    rank.stability = static_cast<double>(counts[m][own[m] - 1]) /
                     static_cast<double>(std::max<std::size_t>(1, resamples.count()));
    rank.low = rankAt(counts[m], skipped);
    std::reverse(counts[m].begin(), counts[m].end());
    rank.high = methods + 1 - rankAt(counts[m], skipped);
    ranked.push_back(rank);
  }
  return ranked;
}

}  // namespace gnomon::compare
