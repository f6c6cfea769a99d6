#include "compare/scenes/binned_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace gnomon::compare {
namespace {

double unit(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11) * 0x1p-53;
}

/// Where every scene lies in the bin with all of its samples, it is the mean over scenes.
TEST(BinnedError, OfWholeScenesIsTheirMean) {
  std::mt19937_64 generator(1);
  std::vector<SceneShare> shares;
  std::vector<double> errors;
  for (int s = 0; s < 40; ++s) {
    errors.push_back(0.2 + 0.2 * unit(generator));
    shares.push_back({1, errors.back()});
  }
  const SceneResamples resamples(40, 999);
  const auto bin = binnedError(shares, resamples);
  const ResampledMean mean(errors, resamples);
  ASSERT_TRUE(bin && bin->interval);
  EXPECT_EQ(bin->scenes, 40U);
  EXPECT_EQ(bin->weight, 1);
  EXPECT_NEAR(bin->errorRate, mean.mean(), 1e-12);
  EXPECT_NEAR(bin->interval->low, mean.interval(0.05)->low, 1e-9);
  EXPECT_NEAR(bin->interval->high, mean.interval(0.05)->high, 1e-9);
}

/// Scenes count by the share of their samples that lies in the bin.
TEST(BinnedError, IsWrongOverAllOfTheBin) {
  const std::vector<SceneShare> shares = {{0.5, 0.1}, {0, 0}, {0.1, 0.1}, {0.4, 0}};
  const auto bin = binnedError(shares, SceneResamples(4, 99));
  ASSERT_TRUE(bin);
  EXPECT_EQ(bin->scenes, 3U);
  EXPECT_DOUBLE_EQ(bin->weight, 0.25);
  EXPECT_DOUBLE_EQ(bin->errorRate, 0.2);
  EXPECT_FALSE(bin->interval) << "too few scenes";
  EXPECT_FALSE(binnedError(std::vector<SceneShare>(4), SceneResamples(4, 99)));
}

/// A ratio of two things that both vary from scene to scene: 0.1 of what lies in the bin is wrong,
/// a little more or less.
TEST(BinnedError, IntervalHoldsTheRatioIn95Of100Cases) {
  std::mt19937_64 generator(2);
  const SceneResamples resamples(50, 999);
  int held = 0;
  constexpr int trials = 1000;
  for (int i = 0; i < trials; ++i) {
    std::vector<SceneShare> shares;
    for (int s = 0; s < 50; ++s) {
      const double weight = unit(generator) < 0.3 ? 0 : unit(generator);
      shares.push_back({weight, weight * 0.2 * unit(generator)});
    }
    const auto bin = binnedError(shares, resamples);
    held += bin->interval->holds(0.1) ? 1 : 0;
  }
  EXPECT_GT(held, 0.93 * trials);
  EXPECT_LT(held, 0.97 * trials);
}

}  // namespace
}  // namespace gnomon::compare
