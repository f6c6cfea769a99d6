#include "compare/scenes/comparisons.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/error.h"
#include "common/lists.h"

namespace gnomon::compare {
namespace {

std::vector<std::size_t> orderOf(const std::vector<std::string>& names) {
  std::vector<std::size_t> order(names.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return names[a] < names[b]; });
  for (std::size_t i = 0; i + 1 < order.size(); ++i) {
    if (names[order[i]] != names[order[i + 1]]) continue;
    throw InternalError(fmt::format("\"{}\" stands twice in a table of scenes", names[order[i]]));
  }
  return order;
}

void requireSize(const char* what, std::size_t found, std::size_t expected) {
  if (found == expected) return;
  throw InternalError(
      fmt::format("table of scenes: {} {} found, {} expected", found, what, expected));
}

void requireValues(const SceneTable& table) {
  for (const auto& row : table.errors) {
    for (const std::optional<double>& error : row) {
      if (!error || (*error >= 0 && *error <= 1)) continue;
      throw InternalError(
          fmt::format("table of scenes: an error of {} found, 0 to 1 expected", *error));
    }
  }
  for (const double uncertainty : table.uncertainty) {
    if (uncertainty >= 0 && std::isfinite(uncertainty)) continue;
    throw InternalError(fmt::format(
        "table of scenes: an uncertainty of {} found, 0 or more expected", uncertainty));
  }
}

}  // namespace

SceneTable sortedByName(const SceneTable& table) {
  requireSize("rows", table.errors.size(), table.methods.size());
  requireSize("uncertainties", table.uncertainty.size(), table.scenes.size());
  for (const auto& row : table.errors) requireSize("errors", row.size(), table.scenes.size());
  requireValues(table);
  SceneTable sorted;
  const std::vector<std::size_t> scenes = orderOf(table.scenes);
  for (const std::size_t s : scenes) {
    sorted.scenes.push_back(table.scenes[s]);
    sorted.uncertainty.push_back(table.uncertainty[s]);
  }
  for (const std::size_t m : orderOf(table.methods)) {
    sorted.methods.push_back(table.methods[m]);
    sorted.errors.emplace_back();
    for (const std::size_t s : scenes) sorted.errors.back().push_back(table.errors[m][s]);
  }
  return sorted;
}

std::vector<std::size_t> sharedScenes(const SceneTable& table,
                                      const std::vector<std::size_t>& methods) {
  std::vector<std::size_t> shared;
  for (std::size_t s = 0; s < table.scenes.size(); ++s) {
    const bool all = std::all_of(methods.begin(), methods.end(),
                                 [&](std::size_t m) { return table.errors.at(m)[s].has_value(); });
    if (all) shared.push_back(s);
  }
  return shared;
}

std::optional<SceneSpread> spreadOver(std::span<const std::optional<double>> errors) {
  std::vector<double> sorted;
  SceneSpread spread;
  for (std::size_t s = 0; s < errors.size(); ++s) {
    if (!errors[s]) continue;
    if (sorted.empty() || *errors[s] > spread.worst) {
      spread.worst = *errors[s];
      spread.worstScene = s;
    }
    sorted.push_back(*errors[s]);
  }
  if (sorted.empty()) return std::nullopt;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t count = sorted.size();
  spread.scenes = count;
  spread.mean = std::accumulate(sorted.begin(), sorted.end(), 0.0) / static_cast<double>(count);
  spread.median = quantile(sorted, 0.5);
  spread.lowerQuartile = quantile(sorted, 0.25);
  spread.upperQuartile = quantile(sorted, 0.75);
  spread.percentile95 = quantile(sorted, 0.95);
  const std::size_t worst = (count + 19) / 20;
  spread.worstTwentieth =
      std::accumulate(sorted.end() - static_cast<std::ptrdiff_t>(worst), sorted.end(), 0.0) /
      static_cast<double>(worst);
  return spread;
}

namespace {

WinShare withProbability(WinShare share) {
  share.probability = (static_cast<double>(share.wins) + static_cast<double>(share.ties) / 2) /
                      static_cast<double>(share.scenes);
  share.interval = wilsonInterval(share.probability, share.scenes);
  return share;
}

int orderOf(double a, double b) {
  return a < b ? -1 : (a > b ? 1 : 0);
}

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

bool isRejected(double probability, double allowed) {
  return probability <= allowed * (1 + 1e-9);
}

std::vector<HolmStep> holmSteps(const std::vector<double>& probabilities) {
  std::vector<std::size_t> order(probabilities.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return probabilities[a] < probabilities[b];
  });
  std::vector<HolmStep> steps(probabilities.size());
  HolmStep last{0, 0};
  bool isOver = false;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const double left = static_cast<double>(order.size() - k);
    const double probability = probabilities[order[k]];
    last.adjusted = std::max(last.adjusted, std::min(1.0, left * probability));
    if (!isOver) last.allowed = 0.05 / left;
    isOver = isOver || !isRejected(probability, last.allowed);
    steps[order[k]] = last;
  }
  return steps;
}

Interval wilsonInterval(double share, std::size_t count) {
  constexpr double z = 1.959963984540054;
  const auto n = static_cast<double>(count);
  const double centre = (share + z * z / (2 * n)) / (1 + z * z / n);
  const double half =
      z / (1 + z * z / n) * std::sqrt(share * (1 - share) / n + z * z / (4 * n * n));
  return {share > 0 ? std::max(0.0, centre - half) : 0,
          share < 1 ? std::min(1.0, centre + half) : 1};
}

WinShare winShare(std::span<const double> first, std::span<const double> second,
                  std::span<const double> uncertainty) {
  if (first.empty() || first.size() != second.size() || first.size() != uncertainty.size()) {
    throw InternalError(fmt::format("{}, {} and {} scenes found, the same number of each expected",
                                    first.size(), second.size(), uncertainty.size()));
  }
  WinShare share{first.size()};
  for (std::size_t s = 0; s < first.size(); ++s) {
    const double difference = first[s] - second[s];
    if (!(std::abs(difference) > uncertainty[s])) {
      ++share.ties;
    } else if (difference < 0) {
      ++share.wins;
    }
  }
  return withProbability(share);
}

WinShare swapped(const WinShare& share) {
  return withProbability({share.scenes, share.scenes - share.wins - share.ties, share.ties});
}

std::optional<double> kendallTau(std::span<const double> first, std::span<const double> second) {
  if (first.size() != second.size()) {
    throw InternalError(fmt::format("rankings of {} and {} found, the same number expected",
                                    first.size(), second.size()));
  }
  double agreement = 0;
  double untiedFirst = 0;
  double untiedSecond = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const int a = orderOf(first[i], first[j]);
      const int b = orderOf(second[i], second[j]);
      agreement += a * b;
      untiedFirst += a * a;
      untiedSecond += b * b;
    }
  }
  if (untiedFirst == 0 || untiedSecond == 0) return std::nullopt;
  return agreement / std::sqrt(untiedFirst * untiedSecond);
}

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
