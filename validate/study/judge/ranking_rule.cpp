#include "study/judge/ranking_rule.h"

#include <algorithm>

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

}  // namespace gnomon
