#include "compare/scenes/kendall.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "common/error.h"

namespace gnomon::compare {
namespace {

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

}  // namespace
}  // namespace gnomon::compare
