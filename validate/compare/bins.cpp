#include "compare/bins.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "common/error.h"
#include "compare/answer_pair.h"
#include "compare/mask_metrics.h"

namespace gnomon::compare {
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
