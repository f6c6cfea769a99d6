#include "common/text/nearest_name.h"

#include <algorithm>
#include <vector>

namespace gnomon {
namespace {

std::size_t mistakes(std::string_view a, std::string_view b) {
  // cost[i][j] turns the first i letters of a into the first j of b.
  std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        cost[i][j] = i + j;
        continue;
      }
      const std::size_t wrong = a[i - 1] == b[j - 1] ? 0 : 1;
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, cost[i - 1][j - 1] + wrong});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
      }
    }
  }
  return cost[a.size()][b.size()];
}

}  // namespace

std::optional<std::string> nearestName(std::string_view typed,
                                       const std::set<std::string, std::less<>>& names) {
  // A long text is no slip of the fingers, and the table above grows with its square.
  constexpr std::size_t longest = 64;
  constexpr std::size_t fewestLetters = 3;  // of a name that was cut off
  if (typed.size() > longest) return std::nullopt;
  std::optional<std::string> nearest;
  std::size_t fewest = 0;
  for (const std::string& name : names) {
    const std::size_t count = mistakes(typed, name);
    if (nearest ? count >= fewest : 3 * count > name.size()) continue;
    nearest = name;
    fewest = count;
  }
  if (nearest || typed.size() < fewestLetters) return nearest;
  for (const std::string& name : names) {
    const bool isShorter = !nearest || name.size() < nearest->size();
    if (name.starts_with(typed) && isShorter) nearest = name;
  }
  return nearest;
}

}  // namespace gnomon
