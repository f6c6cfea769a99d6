#include "compare/worst_windows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <span>
#include <vector>

namespace gnomon::compare {
namespace {

double wrongIn(const std::vector<float>& wrong, int width, const Window& window) {
  double count = 0;
  for (int y = window.top; y < window.top + window.side; ++y) {
    for (int x = window.left; x < window.left + window.side; ++x) {
      count += wrong.at(static_cast<std::size_t>(y * width + x));
    }
  }
  return count;
}

TEST(WorstWindows, FindsWhatCountingEverySquareFinds) {
  constexpr int width = 23, height = 17, side = 5;
  std::mt19937 random(1);
  std::vector<float> wrong(static_cast<std::size_t>(width * height));
  // Wrong, right, and by parts, which sums hold exactly.
  for (float& pixel : wrong) pixel = static_cast<float>(random() % 5) / 4;
  const std::vector<Window> found =
      worstWindows(std::span<const float>(wrong), width, height, side, 3);
  ASSERT_EQ(found.size(), 3U);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].error, wrongIn(wrong, width, found[i]));
    double most = 0;
    for (int y = 0; y + side <= height; ++y) {
      for (int x = 0; x + side <= width; ++x) {
        const bool isFree = std::none_of(
            found.begin(), found.begin() + static_cast<std::ptrdiff_t>(i), [&](const Window& w) {
              return std::abs(w.left - x) < side && std::abs(w.top - y) < side;
            });
        if (isFree) most = std::max(most, wrongIn(wrong, width, {x, y, side, 0}));
      }
    }
    EXPECT_EQ(found[i].error, most) << i;
  }
}

TEST(WorstWindows, NoneWithoutErrorsAndNoneBeyondThePicture) {
  EXPECT_TRUE(worstWindows(std::span<const float>(std::vector<float>(12, 0)), 4, 3, 64, 3).empty());
  EXPECT_TRUE(worstWindows(std::span<const float>(), 0, 0, 64, 3).empty());
  std::vector<float> wrong(12, 0);
  wrong[11] = 1;  // the last column of the last row
  const std::vector<Window> found = worstWindows(std::span<const float>(wrong), 4, 3, 64, 3);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].left, 1);
  EXPECT_EQ(found[0].top, 0);
  EXPECT_EQ(found[0].side, 3);
  EXPECT_EQ(found[0].error, 1);
}

TEST(WorstWindows, OfMarksAreThoseOfOnesAndZeros) {
  std::mt19937 random(3);
  std::vector<float> errors(50 * 40);
  std::vector<std::uint8_t> marks(errors.size());
  for (std::size_t i = 0; i < marks.size(); ++i) {
    marks[i] = random() % 9 == 0 ? 1 : 0;
    errors[i] = marks[i];
  }
  const auto found = worstWindows(std::span<const std::uint8_t>(marks), 50, 40, 7, 4);
  const auto expected = worstWindows(std::span<const float>(errors), 50, 40, 7, 4);
  ASSERT_EQ(found.size(), 4U);
  ASSERT_EQ(expected.size(), found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].left, expected[i].left);
    EXPECT_EQ(found[i].top, expected[i].top);
    EXPECT_EQ(found[i].error, expected[i].error);
  }
}

}  // namespace
}  // namespace gnomon::compare
