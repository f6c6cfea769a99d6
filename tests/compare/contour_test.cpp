#include "compare/contour.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

#include "compare/drawn_mask.h"

namespace gnomon::compare {
namespace {

using test::drawn;

/// A few dark samples, all in the left third, so that most places are far from every side.
Mask sparseMask(int width, int height) {
  std::mt19937 random(7);
  Mask mask = drawn(width, height, [](int, int) { return false; });
  for (int k = 0; k < 9; ++k) {
    const std::size_t column = random() % static_cast<unsigned>(width / 3);
    const std::size_t row = random() % static_cast<unsigned>(height);
    mask.samples[row * static_cast<std::size_t>(width) + column] = Shade::shadowed;
  }
  return mask;
}

/// To every side, one after the other.
double distanceTo(const Contour& contour, const SampleLayout& layout, int halfColumn, int halfRow) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t row = 0; row + 1 < contour.rowStarts.size(); ++row) {
    for (std::size_t i = contour.rowStarts[row]; i < contour.rowStarts[row + 1]; ++i) {
      least = std::min(least, std::hypot((contour.columns[i] - halfColumn) * layout.columnStep / 2,
                                         (static_cast<int>(row) - halfRow) * layout.rowStep / 2));
    }
  }
  return least;
}

/// Steps from where half of `nearby` is one half column to where it is more than are looked at one
/// by one.
class Distances : public testing::TestWithParam<SampleLayout> {};

TEST_P(Distances, AreThoseToTheNearestSide) {
  const SampleLayout& layout = GetParam();
  constexpr int width = 400;
  constexpr int height = 60;
  const Mask mask = sparseMask(width, height);
  const Contour contour = contourOf(mask, mask, layout);
  ASSERT_GT(contour.size(), 20U);
  for (const int first : {0, 37}) {
    ContourDistances distances(contour, layout, first);
    for (int row = first; row < 2 * height - 1; row += row % 3 + 1) {
      distances.moveTo(row);
      for (int k = 0; k < 115; ++k) {
        const int column = 331 * k % (2 * width - 1);  // right and left, near and far
        const double right = distanceTo(contour, layout, column, row);
        EXPECT_DOUBLE_EQ(distances.from(column), right) << column << ", " << row;
        const double nearby = distances.fromNearby(column);
        if (right <= ContourDistances::nearby) {
          EXPECT_DOUBLE_EQ(nearby, right) << column << ", " << row;
        } else {
          EXPECT_GT(nearby, ContourDistances::nearby) << column << ", " << row;
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OfSamples, Distances,
                         testing::Values(SampleLayout{1, 1, 0, {}}, SampleLayout{7, 7, 0, {}},
                                         SampleLayout{0.3, 0.2, 0, {}},
                                         SampleLayout{0.02, 1.5, 0, {}},
                                         SampleLayout{0.004, 0.004, 0, {}}));

TEST(ContourDistances, WithoutASideAreInfinite) {
  const Mask mask = drawn(9, 4, [](int, int) { return true; });
  const Contour contour = contourOf(mask, mask, {});
  ContourDistances distances(contour, {}, 0);
  distances.moveTo(3);
  EXPECT_EQ(distances.from(4), std::numeric_limits<double>::infinity());
  EXPECT_EQ(distances.fromNearby(4), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace gnomon::compare
