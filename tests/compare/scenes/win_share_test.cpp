#include "compare/scenes/win_share.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "common/error.h"

namespace gnomon::compare {
namespace {

TEST(WinShare, CountsWinsAndHalfTheTies) {
  const std::vector<double> first = {0.1, 0.2, 0.3, 0.1};
  const std::vector<double> second = {0.2, 0.2, 0.1, 0.11};
  const WinShare exact = winShare(first, second, std::vector<double>(4));
  EXPECT_EQ(exact.scenes, 4U);
  EXPECT_EQ(exact.wins, 2U);
  EXPECT_EQ(exact.ties, 1U);
  EXPECT_EQ(exact.probability, 2.5 / 4);
  // The last difference is within the truth's uncertainty.
  const WinShare uncertain = winShare(first, second, std::vector<double>{0, 0, 0, 0.02});
  EXPECT_EQ(uncertain.ties, 2U);
  EXPECT_EQ(uncertain.probability, 0.5);
}

TEST(WinShare, OfTheOtherMethodAddsUpToOne) {
  const std::vector<double> first = {0.1, 0.2, 0.3, 0.1, 0.4};
  const std::vector<double> second = {0.2, 0.2, 0.1, 0.11, 0.5};
  const WinShare share = winShare(first, second, std::vector<double>(5));
  const WinShare other = winShare(second, first, std::vector<double>(5));
  EXPECT_EQ(swapped(share).wins, other.wins);
  EXPECT_EQ(swapped(share).ties, other.ties);
  EXPECT_EQ(swapped(share).probability, other.probability);
  EXPECT_DOUBLE_EQ(share.probability + other.probability, 1);
  EXPECT_NEAR(share.interval.low, 1 - other.interval.high, 1e-12);
}

TEST(WinShare, OfAMethodWithItselfIsAHalf) {
  const std::vector<double> errors = {0.1, 0.2, 0.3};
  EXPECT_EQ(winShare(errors, errors, std::vector<double>(3)).probability, 0.5);
}

/// Newcombe (1998), table I: 81 of 263, and none of 20.
TEST(Wilson, OfPublishedExamples) {
  const Interval some = wilsonInterval(81.0 / 263, 263);
  EXPECT_NEAR(some.low, 0.2553, 5e-5);
  EXPECT_NEAR(some.high, 0.3662, 5e-5);
  const Interval none = wilsonInterval(0, 20);
  EXPECT_EQ(none.low, 0);
  EXPECT_NEAR(none.high, 0.1611, 5e-5);
  EXPECT_EQ(wilsonInterval(1, 20).high, 1);
}

/// Its ends are where the share is 1.96 standard deviations away.
TEST(Wilson, IsWhereTheShareIsJustProbable) {
  for (const double share : {0.1, 0.35, 0.5, 0.875}) {
    const Interval interval = wilsonInterval(share, 40);
    for (const double end : {interval.low, interval.high}) {
      EXPECT_NEAR(std::abs(share - end) / std::sqrt(end * (1 - end) / 40), 1.959964, 1e-5);
    }
  }
}

TEST(WinShare, RefusesOtherNumbersOfScenes) {
  EXPECT_THROW(winShare({}, {}, {}), InternalError);
  EXPECT_THROW(winShare(std::vector<double>(2), std::vector<double>(3), std::vector<double>(2)),
               InternalError);
}

}  // namespace
}  // namespace gnomon::compare
