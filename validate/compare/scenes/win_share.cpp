#include "compare/scenes/win_share.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "common/error.h"

namespace gnomon::compare {
namespace {

WinShare withProbability(WinShare share) {
  share.probability = (static_cast<double>(share.wins) + static_cast<double>(share.ties) / 2) /
                      static_cast<double>(share.scenes);
  share.interval = wilsonInterval(share.probability, share.scenes);
  return share;
}

}  // namespace

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

}  // namespace gnomon::compare
