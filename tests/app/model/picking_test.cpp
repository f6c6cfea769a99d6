#include "model/picking.h"

#include <gtest/gtest.h>

namespace gnomon::app {
namespace {

TEST(Picking, FindsEveryPixelAtItsMiddle) {
  const PaneRectangle rectangle{{17, 40}, {640, 300}};
  constexpr int width = 97;
  constexpr int height = 33;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const Vec2 middle =
          rectangle.corner + rectangle.size * Vec2(column + 0.5, row + 0.5) / Vec2(width, height);
      EXPECT_EQ(pixelUnder(middle, rectangle, width, height), (ViewPixel{column, row}));
    }
  }
}

TEST(Picking, EndsAtTheBorder) {
  const PaneRectangle rectangle{{10, 20}, {100, 50}};
  EXPECT_EQ(pixelUnder({10, 20}, rectangle, 10, 5), (ViewPixel{0, 0}));
  EXPECT_EQ(pixelUnder({109.99, 69.99}, rectangle, 10, 5), (ViewPixel{9, 4}));
  EXPECT_FALSE(pixelUnder({9.99, 30}, rectangle, 10, 5));
  EXPECT_FALSE(pixelUnder({110, 30}, rectangle, 10, 5));
  EXPECT_FALSE(pixelUnder({50, 70}, rectangle, 10, 5));
  EXPECT_FALSE(pixelUnder({50, 30}, {{10, 20}, {0, 0}}, 10, 5));
}

TEST(Picking, GivesTheSampleOfAPixel) {
  surface::SampleGrid grid{3, 2, std::vector<surface::SurfaceSample>(6)};
  grid.samples[4] = {7, 0.25F, 0.75F};
  const auto sample = sampleUnder(grid, {1, 1});
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample->face, 7);
  EXPECT_EQ(sample->t, 0.75F);
  EXPECT_FALSE(sampleUnder(grid, {0, 0}));
  for (const ViewPixel outside : {ViewPixel{-1, 0}, {3, 1}, {1, 2}, {1, -1}}) {
    EXPECT_FALSE(sampleUnder(grid, outside));
  }
}

}  // namespace
}  // namespace gnomon::app
