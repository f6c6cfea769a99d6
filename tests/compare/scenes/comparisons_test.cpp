#include "compare/scenes/comparisons.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/error.h"

namespace gnomon::compare {
namespace {

std::vector<double> adjusted(const std::vector<double>& probabilities) {
  std::vector<double> found;
  for (const HolmStep& step : holmSteps(probabilities)) found.push_back(step.adjusted);
  return found;
}

void expectNear(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-12) << i;
}

/// The example of most texts: of four hypotheses the fourth and the first are rejected.
TEST(Holm, OfATextbookExample) {
  const std::vector<double> probabilities = {0.01, 0.04, 0.03, 0.005};
  expectNear(adjusted(probabilities), {0.03, 0.06, 0.06, 0.02});
  const std::vector<HolmStep> steps = holmSteps(probabilities);
  expectNear({steps[0].allowed, steps[1].allowed, steps[2].allowed, steps[3].allowed},
             {0.05 / 3, 0.05 / 2, 0.05 / 2, 0.05 / 4});
  EXPECT_TRUE(isRejected(probabilities[3], steps[3].allowed));
  EXPECT_TRUE(isRejected(probabilities[0], steps[0].allowed));
  EXPECT_FALSE(isRejected(probabilities[2], steps[2].allowed));
  EXPECT_FALSE(isRejected(probabilities[1], steps[1].allowed));
}

/// p.adjust(…, "holm") of R.
TEST(Holm, NeverFallsFromStepToStep) {
  expectNear(adjusted({0.01, 0.02, 0.03, 0.04, 0.05}), {0.05, 0.08, 0.09, 0.09, 0.09});
  expectNear(adjusted({0.5, 0.9, 0.9}), {1, 1, 1});
  expectNear(adjusted({0.05}), {0.05});
  EXPECT_TRUE(holmSteps({}).empty());
}

/// Once a step is no rejection, none after it is one, although its own p would do alone.
TEST(Holm, StopsAtTheFirstThatIsNoRejection) {
  const std::vector<double> probabilities = {0.03, 0.04};
  for (const HolmStep& step : holmSteps(probabilities)) {
    EXPECT_FALSE(isRejected(0.03, step.allowed));
    EXPECT_GT(step.adjusted, 0.05);
  }
}

/// Both ways to ask say the same, also where p is the allowed error itself but for rounding.
TEST(Holm, AdjustedAndAllowedAgree) {
  std::vector<double> probabilities;
  for (int c = 1; c <= 190; ++c) probabilities.push_back(c * c / 20000.0 / 3);
  probabilities.push_back(50 / 20000.0 / 20);
  std::reverse(probabilities.begin(), probabilities.end());
  const std::vector<HolmStep> steps = holmSteps(probabilities);
  std::size_t rejected = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const bool is = isRejected(probabilities[i], steps[i].allowed);
    EXPECT_EQ(is, isRejected(steps[i].adjusted, 0.05)) << i;
    rejected += is ? 1 : 0;
  }
  EXPECT_GT(rejected, 1U);
  EXPECT_LT(rejected, 100U);
}

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

using Ranks = std::vector<double>;

TEST(Kendall, OfRankingsByHand) {
  EXPECT_EQ(kendallTau(Ranks{1, 2, 3, 4}, Ranks{1, 2, 3, 4}), 1);
  EXPECT_EQ(kendallTau(Ranks{1, 2, 3, 4}, Ranks{4, 3, 2, 1}), -1);
  // 6 of the 10 pairs agree.
  EXPECT_NEAR(*kendallTau(Ranks{1, 2, 3, 4, 5}, Ranks{3, 4, 1, 2, 5}), 0.2, 1e-12);
  // One swap of neighbours.
  EXPECT_NEAR(*kendallTau(Ranks{1, 2, 3, 4}, Ranks{1, 3, 2, 4}), 4.0 / 6, 1e-12);
}

TEST(Kendall, LeavesOutTies) {
  // Five of six pairs are untied in the first, all in the second, and all of the five agree.
  EXPECT_NEAR(*kendallTau(Ranks{1, 2, 2, 3}, Ranks{1, 3, 2, 4}), 5 / std::sqrt(30.0), 1e-12);
  EXPECT_FALSE(kendallTau(Ranks{1, 1, 1}, Ranks{1, 2, 3}));
  EXPECT_FALSE(kendallTau(Ranks{}, Ranks{}));
}

TEST(Kendall, DependsOnTheOrderAlone) {
  const Ranks first = {0.03, 0.5, 0.1, 0.2};
  const Ranks second = {1, 4, 3, 2};
  EXPECT_EQ(kendallTau(first, second), kendallTau(second, first));
  EXPECT_EQ(kendallTau(first, second), kendallTau(Ranks{1, 4, 2, 3}, second));
  EXPECT_THROW(kendallTau(first, Ranks{1}), InternalError);
}

TEST(SceneRank, OfMethodsThatNeverMeetIsCertain) {
  std::vector<std::vector<double>> errors(3);
  for (int s = 0; s < 30; ++s) {
    errors[0].push_back(0.5 + 0.001 * s);
    errors[1].push_back(0.1 + 0.001 * s);
    errors[2].push_back(0.2 + 0.001 * s);
  }
  const auto ranks = ranksOver(errors, SceneResamples(30, 999));
  const std::vector<std::size_t> expected = {3, 1, 2};
  for (std::size_t m = 0; m < 3; ++m) {
    EXPECT_EQ(ranks[m].rank, expected[m]);
    EXPECT_EQ(ranks[m].low, expected[m]);
    EXPECT_EQ(ranks[m].high, expected[m]);
    EXPECT_EQ(ranks[m].stability, 1);
  }
}

/// Two methods that win in turn, of nearly the same mean: either is first in half of the resamples.
TEST(SceneRank, OfMethodsThatWinInTurnIsOpen) {
  std::vector<std::vector<double>> errors(2);
  for (int s = 0; s < 40; ++s) {
    errors[0].push_back(s % 2 == 0 ? 0.1 : 0.3);
    errors[1].push_back(s % 2 == 0 ? 0.3 + 0.0001 * s : 0.1);
  }
  const auto ranks = ranksOver(errors, SceneResamples(40, 1999));
  EXPECT_EQ(ranks[0].rank, 1U);
  EXPECT_EQ(ranks[1].rank, 2U);
  for (const SceneRank& rank : ranks) {
    EXPECT_NEAR(rank.stability, 0.5, 0.1);
    EXPECT_EQ(rank.low, 1U);
    EXPECT_EQ(rank.high, 2U);
  }
}

TEST(SceneRank, OfEqualMethodsIsTheSame) {
  const std::vector<double> errors(25, 0.2);
  for (const SceneRank& rank : ranksOver({errors, errors}, SceneResamples(25, 99))) {
    EXPECT_EQ(rank.rank, 1U);
    EXPECT_EQ(rank.high, 1U);
    EXPECT_EQ(rank.stability, 1);
  }
}

}  // namespace

}  // namespace gnomon::compare
