#include "cli/shards/division.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "common/error.h"

namespace gnomon::cli {
namespace {

using ::testing::ElementsAre;

using Costs = std::vector<std::uint64_t>;

std::vector<std::uint64_t> partsOf(const Costs& costs, int count) {
  const std::vector<std::size_t> begins = dividedByCost(costs, count);
  std::vector<std::uint64_t> sums;
  for (std::size_t i = 0; i + 1 < begins.size(); ++i) {
    const auto at = [&](std::size_t place) {
      return costs.begin() + static_cast<std::ptrdiff_t>(begins[place]);
    };
    sums.push_back(std::accumulate(at(i), at(i + 1), std::uint64_t{0}));
  }
  return sums;
}

TEST(Division, EqualCasesComeInPartsThatDifferByOne) {
  for (const std::size_t cases : {1U, 7U, 64U, 1000U}) {
    for (const int count : {1, 2, 3, 7, 64, 100}) {
      const auto parts = partsOf(Costs(cases, 10), count);
      ASSERT_EQ(parts.size(), static_cast<std::size_t>(count));
      const auto [least, most] = std::minmax_element(parts.begin(), parts.end());
      EXPECT_LE(*most - *least, 10U) << cases << " in " << count;
      EXPECT_EQ(std::accumulate(parts.begin(), parts.end(), std::uint64_t{0}), 10 * cases);
    }
  }
}

TEST(Division, FollowsTheCost) {
  EXPECT_THAT(dividedByCost(Costs{4, 1, 1, 1, 1}, 2), ElementsAre(0, 1, 5));
  EXPECT_THAT(dividedByCost(Costs{1, 1, 1, 1, 4}, 2), ElementsAre(0, 4, 5));
  EXPECT_THAT(dividedByCost(Costs{100, 1, 1, 1}, 3), ElementsAre(0, 1, 2, 4));
  EXPECT_THAT(dividedByCost(Costs{1, 1, 1, 100}, 3), ElementsAre(0, 2, 3, 4));
}

TEST(Division, MoreShardsThanCasesLeaveTheLastEmpty) {
  EXPECT_THAT(dividedByCost(Costs{5, 5}, 4), ElementsAre(0, 1, 2, 2, 2));
  EXPECT_THAT(dividedByCost(Costs{}, 2), ElementsAre(0, 0, 0));
}

/// The bound of the header, on costs that scatter over four decades.
TEST(Division, NoPartExceedsTheMeanByMoreThanTheDearestCase) {
  std::mt19937_64 random(7);
  for (int trial = 0; trial < 500; ++trial) {
    Costs costs(1 + random() % 200);
    for (auto& cost : costs) {
      cost = 1 + static_cast<std::uint64_t>(
                     std::pow(10.0, 4.0 * static_cast<double>(random() % 1000) / 1000));
    }
    const int count = 1 + static_cast<int>(random() % 70);
    const auto parts = partsOf(costs, count);
    const std::uint64_t all = std::accumulate(costs.begin(), costs.end(), std::uint64_t{0});
    const std::uint64_t dearest = *std::max_element(costs.begin(), costs.end());
    for (const std::uint64_t part : parts) {
      EXPECT_LE(part, all / static_cast<std::uint64_t>(count) + 1 + dearest);
    }
    if (costs.size() >= static_cast<std::size_t>(count)) {
      EXPECT_GT(*std::min_element(parts.begin(), parts.end()), 0U);
    }
  }
}

TEST(Division, DearCasesDoNotOverflow) {
  const Costs costs(1'000'000, 1'000'000'000'000U);
  const auto begins = dividedByCost(costs, 100'000);
  for (std::size_t i = 0; i + 1 < begins.size(); ++i) EXPECT_EQ(begins[i + 1] - begins[i], 10U);
}

TEST(Division, NeedsAPart) {
  EXPECT_THROW((void)dividedByCost(Costs{1}, 0), InternalError);
}

}  // namespace
}  // namespace gnomon::cli
