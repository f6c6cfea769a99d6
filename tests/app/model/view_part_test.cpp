#include "model/view_part.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace gnomon::app {
namespace {

const PaneRectangle pane{{20, 40}, {200, 100}};

std::size_t countOf(const std::vector<std::uint8_t>& pixels) {
  return std::accumulate(pixels.begin(), pixels.end(), std::size_t{0});
}

TEST(ViewPart, IsTheRectangleOfADragWhicheverWayItGoes) {
  const ViewPart expected{0.25, 0.1, 0.75, 0.6};
  for (const auto& [one, other] : {std::pair(Vec2(70, 50), Vec2(170, 100)),
                                   {Vec2(170, 100), Vec2(70, 50)},
                                   {Vec2(70, 100), Vec2(170, 50)}}) {
    EXPECT_EQ(partBetween(one, other, pane), expected);
  }
  const PaneRectangle place = placeOf(expected, pane);
  EXPECT_EQ(place.corner, Vec2(70, 50));
  EXPECT_EQ(place.size, Vec2(100, 50));
}

TEST(ViewPart, EndsAtThePane) {
  EXPECT_EQ(partBetween({120, 90}, {900, -5}, pane), (ViewPart{0.5, 0, 1, 0.5}));
  EXPECT_FALSE(partBetween({70, 50}, {70, 90}, pane)) << "no width";
  EXPECT_FALSE(partBetween({300, 50}, {400, 90}, pane)) << "beside the pane";
}

TEST(ViewPart, HoldsTheSamplesWhoseCentresLieInIt) {
  constexpr int width = 37;
  constexpr int height = 21;
  std::mt19937 random(3);
  const auto share = [&] { return static_cast<double>(random() % 1001) / 1000; };
  for (int k = 0; k < 200; ++k) {
    const auto part = partBetween({20 + 200 * share(), 40 + 100 * share()},
                                  {20 + 200 * share(), 40 + 100 * share()}, pane);
    if (!part) continue;
    const auto pixels = pixelsIn(*part, width, height);
    ASSERT_EQ(pixels.size(), static_cast<std::size_t>(width * height));
    for (int row = 0; row < height; ++row) {
      for (int column = 0; column < width; ++column) {
        const double x = (column + 0.5) / width;
        const double y = (row + 0.5) / height;
        const bool inside =
            x >= part->left && x < part->right && y >= part->top && y < part->bottom;
        ASSERT_EQ(pixels[static_cast<std::size_t>(row * width + column)], inside ? 1 : 0)
            << column << " " << row;
      }
    }
  }
}

/// The identity that makes errors of parts add up.
TEST(ViewPart, PartsWithACommonSideShareNoSampleAndLoseNone) {
  for (const double cut : {0.0, 0.1, 1.0 / 3, 0.5, 0.77, 1.0}) {
    const std::size_t left = countOf(pixelsIn({0, 0, cut, 1}, 41, 13));
    const std::size_t right = countOf(pixelsIn({cut, 0, 1, 1}, 41, 13));
    EXPECT_EQ(left + right, std::size_t{41 * 13}) << cut;
    const std::size_t upper = countOf(pixelsIn({0, 0, 1, cut}, 41, 13));
    EXPECT_EQ(upper + countOf(pixelsIn({0, cut, 1, 1}, 41, 13)), std::size_t{41 * 13}) << cut;
  }
}

}  // namespace
}  // namespace gnomon::app
