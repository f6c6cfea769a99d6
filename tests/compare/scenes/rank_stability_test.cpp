#include "compare/scenes/rank_stability.h"

#include <gtest/gtest.h>

#include <vector>

namespace gnomon::compare {
namespace {

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
