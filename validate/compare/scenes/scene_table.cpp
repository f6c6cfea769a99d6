#include "compare/scenes/scene_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

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

}  // namespace gnomon::compare
