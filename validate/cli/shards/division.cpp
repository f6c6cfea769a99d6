#include "cli/shards/division.h"

#include <numeric>

#include "common/error.h"

namespace gnomon::cli {

std::vector<std::size_t> dividedByCost(std::span<const std::uint64_t> costs, int count) {
  if (count < 1) throw InternalError("a division into no part");
  __extension__ using Wide = unsigned __int128;
  const auto parts = static_cast<std::uint64_t>(count);
  const std::uint64_t all = std::accumulate(costs.begin(), costs.end(), std::uint64_t{0});
  std::vector<std::size_t> begins = {0};
  std::uint64_t cost = 0;  // of all cases before `next`
  std::size_t next = 0;
  for (std::uint64_t part = 1; part <= parts; ++part) {
    for (bool isFirst = true; next < costs.size(); isFirst = false, ++next) {
      const bool isNeeded = costs.size() - next <= parts - part;  // by the parts behind this one
      // One more comes nearer to all · part / parts where that lies behind the case's middle.
      const bool comesNearer = Wide{2} * all * part >= Wide{parts} * (Wide{2} * cost + costs[next]);
      if (!isFirst && (isNeeded || !comesNearer)) break;
      cost += costs[next];
    }
    begins.push_back(next);
  }
  return begins;
}

}  // namespace gnomon::cli
