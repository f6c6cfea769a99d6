#include "relief/resampled_heights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/error.h"
#include "support/error_messages.h"

namespace gnomon::relief {
namespace {

/// Heights between -1 and 1 that have nothing to do with each other: a kink on every centre line.
HeightField randomHeights(int width, int height, Wrap wrap) {
  std::mt19937 random(7);
  std::vector<float> texels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (float& h : texels) h = static_cast<float>(random()) * 0x1p-31F - 1;
  return {width, height, std::move(texels), wrap};
}

class ResampledHeights : public testing::TestWithParam<std::tuple<int, Wrap>> {};

TEST_P(ResampledHeights, AreTheSameFunctionEverywhere) {
  const auto [factor, wrap] = GetParam();
  const HeightField coarse = randomHeights(11, 7, wrap);
  const HeightField fine = resampledHeights(coarse, factor, 1);
  EXPECT_EQ(fine.width(), 11 * factor);
  EXPECT_EQ(fine.height(), 7 * factor);
  EXPECT_EQ(fine.wrap(), wrap);
  std::mt19937 random(3);
  // Three maps around, so that the border is crossed on all sides.
  std::uniform_real_distribution<double> x(-11, 22);
  std::uniform_real_distribution<double> y(-7, 14);
  // A height is rounded once, by half of 2⁻²³ at 1; the function mixes four of them.
  const double rounding = 0x1p-24;
  for (int i = 0; i < 20000; ++i) {
    const Vec2 place(x(random), y(random));
    ASSERT_NEAR(fine.at(place * static_cast<double>(factor)), coarse.at(place), rounding)
        << place.x << " " << place.y;
  }
}

TEST_P(ResampledHeights, HoldTheOldTexelsToTheBit) {
  const auto [factor, wrap] = GetParam();
  const HeightField coarse = randomHeights(11, 7, wrap);
  const HeightField fine = resampledHeights(coarse, factor, 1);
  const int middle = (factor - 1) / 2;
  for (int j = 0; j < 7; ++j) {
    for (int i = 0; i < 11; ++i) {
      ASSERT_EQ(fine.texel(i * factor + middle, j * factor + middle), coarse.texel(i, j));
    }
  }
}

TEST_P(ResampledHeights, CountTexelsOnceMoreWhereHeightsDo) {
  const auto [factor, wrap] = GetParam();
  const HeightField coarse = randomHeights(5, 4, wrap);
  const HeightField once = resampledHeights(coarse, factor, 1);
  const HeightField scaled = resampledHeights(coarse, factor, factor);
  for (std::size_t i = 0; i < once.texels().size(); ++i) {
    ASSERT_NEAR(scaled.texels()[i], static_cast<float>(factor) * once.texels()[i],
                factor * 0x1p-23);
  }
}

INSTANTIATE_TEST_SUITE_P(Factors, ResampledHeights,
                         testing::Combine(testing::Values(1, 3, 5, 9),
                                          testing::Values(Wrap::repeat, Wrap::clamp)));

TEST(ResampledHeightsErrors, AnEvenFactorIsAnotherFunction) {
  EXPECT_THROW((void)resampledHeights(randomHeights(4, 4, Wrap::clamp), 2, 1), InternalError);
}

TEST(ResampledHeightsErrors, WhatDoesNotFitIsRefusedBeforeItIsAllocated) {
  const HeightField field = randomHeights(1024, 1024, Wrap::clamp);
  EXPECT_THAT(messageOf<MemoryError>([&] { (void)resampledHeights(field, 32767, 1); }),
              testing::StartsWith("factor: 32767, a map of 33553408 × 33553408 texels"));
}

}  // namespace
}  // namespace gnomon::relief
