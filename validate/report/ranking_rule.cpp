#include "report/ranking_rule.h"

#include <fmt/core.h>

#include <algorithm>

#include "report/number_text.h"

namespace gnomon {

std::vector<RankingPlace> rankByError(const std::vector<RankingEntry>& entries, std::size_t cases) {
  std::vector<RankingPlace> places;
  for (std::size_t i = 0; i < entries.size(); ++i) places.push_back({i, std::nullopt});
  const auto rest = std::stable_partition(places.begin(), places.end(), [&](const auto& place) {
    const RankingEntry& entry = entries[place.entry];
    return entry.error && entry.cases == cases;
  });
  std::stable_sort(places.begin(), rest, [&](const auto& a, const auto& b) {
    return *entries[a.entry].error < *entries[b.entry].error;
  });
  std::stable_sort(rest, places.end(), [&](const auto& a, const auto& b) {
    return entries[a.entry].cases > entries[b.entry].cases;
  });
  for (auto place = places.begin(); place != rest; ++place) {
    place->rank = static_cast<std::size_t>(place - places.begin()) + 1;
  }
  return places;
}

std::string fewerCasesText(std::size_t cases, std::size_t allCases, const std::string& best,
                           std::optional<double> leaderError) {
  const std::string text = fmt::format("in {} of {} cases: no rank", cases, allCases);
  if (!leaderError) return text;
  return fmt::format("{}; {} has {} % on the same", text, best, percentText(leaderError));
}

}  // namespace gnomon
