#include "compare/scenes/comparisons.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "common/error.h"

namespace gnomon::compare {
namespace {

SceneTable table() {
  return {{"b", "a"}, {"new", "flat"}, {{0.1, std::nullopt}, {0.2, 0.3}}, {0.01, 0.02}};
}

TEST(SceneTable, IsSortedByName) {
  const SceneTable sorted = sortedByName(table());
  EXPECT_EQ(sorted.scenes, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(sorted.methods, (std::vector<std::string>{"flat", "new"}));
  EXPECT_EQ(sorted.errors[0], (std::vector<std::optional<double>>{0.3, 0.2}));
  EXPECT_EQ(sorted.errors[1], (std::vector<std::optional<double>>{std::nullopt, 0.1}));
  EXPECT_EQ(sorted.uncertainty, (std::vector<double>{0.02, 0.01}));
  EXPECT_EQ(sharedScenes(sorted, {0, 1}), (std::vector<std::size_t>{1}));
  EXPECT_EQ(sharedScenes(sorted, {0}), (std::vector<std::size_t>{0, 1}));
}

TEST(SceneTable, RefusesWhatIsNone) {
  SceneTable twice = table();
  twice.scenes = {"a", "a"};
  EXPECT_THROW(sortedByName(twice), InternalError);
  SceneTable narrow = table();
  narrow.errors[1].pop_back();
  EXPECT_THROW(sortedByName(narrow), InternalError);
  SceneTable large = table();
  large.errors[0][0] = 1.1;
  EXPECT_THROW(sortedByName(large), InternalError);
  SceneTable unknown = table();
  unknown.errors[0][0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(sortedByName(unknown), InternalError);
  unknown = table();
  unknown.uncertainty[1] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(sortedByName(unknown), InternalError);
}

using Errors = std::vector<std::optional<double>>;

/// 0.01, 0.02 … 0.40, whose quantiles are known.
TEST(SceneSpread, OfEvenlySpacedErrorsIsAClosedForm) {
  Errors errors;
  for (int i = 40; i >= 1; --i) errors.emplace_back(i / 100.0);
  const auto spread = spreadOver(errors);
  ASSERT_TRUE(spread);
  EXPECT_EQ(spread->scenes, 40U);
  EXPECT_NEAR(spread->mean, 0.205, 1e-12);
  EXPECT_NEAR(spread->median, 0.205, 1e-12);
  EXPECT_NEAR(spread->lowerQuartile, 0.1075, 1e-12);
  EXPECT_NEAR(spread->upperQuartile, 0.3025, 1e-12);
  EXPECT_NEAR(spread->percentile95, 0.3805, 1e-12);
  EXPECT_NEAR(spread->worstTwentieth, (0.39 + 0.40) / 2, 1e-12);
  EXPECT_EQ(spread->worst, 0.40);
  EXPECT_EQ(spread->worstScene, 0U);
}

TEST(SceneSpread, RoundsTheWorstTwentiethUp) {
  Errors errors(21, 0.1);
  errors[5] = 0.4;
  errors[9] = 0.2;
  EXPECT_NEAR(spreadOver(errors)->worstTwentieth, 0.3, 1e-12);
  errors.pop_back();
  EXPECT_NEAR(spreadOver(errors)->worstTwentieth, 0.4, 1e-12);
  EXPECT_EQ(spreadOver(errors)->worstScene, 5U);
}

TEST(SceneSpread, LeavesOutWhatWasNotMeasured) {
  const auto spread = spreadOver(Errors{std::nullopt, 0.2, std::nullopt, 0.4});
  EXPECT_EQ(spread->scenes, 2U);
  EXPECT_NEAR(spread->mean, 0.3, 1e-12);
  EXPECT_EQ(spread->worstScene, 3U);
  EXPECT_FALSE(spreadOver(Errors{std::nullopt}));
  EXPECT_FALSE(spreadOver({}));
}

}  // namespace

}  // namespace gnomon::compare
