#include "compare/worst_windows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

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
  const std::vector<Window> found = worstWindows(wrong, width, height, side, 3);
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
  EXPECT_TRUE(worstWindows(std::vector<float>(12, 0), 4, 3, 64, 3).empty());
  EXPECT_TRUE(worstWindows({}, 0, 0, 64, 3).empty());
  std::vector<float> wrong(12, 0);
  wrong[11] = 1;  // the last column of the last row
  const std::vector<Window> found = worstWindows(wrong, 4, 3, 64, 3);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].left, 1);
  EXPECT_EQ(found[0].top, 0);
  EXPECT_EQ(found[0].side, 3);
  EXPECT_EQ(found[0].error, 1);
}

}  // namespace
}  // namespace gnomon::compare
