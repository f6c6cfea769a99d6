#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <string_view>
#include <utility>
#include <vector>

#include "common/error.h"
#include "compare/answer_metrics.h"
#include "compare/boundaries.h"
#include "compare/boundary_values.h"
#include "compare/contour.h"
#include "compare/drawn_mask.h"
#include "compare/masks.h"

namespace gnomon::compare {
namespace {

using test::complement;
using test::drawn;
using test::expectAlike;
using test::placeOf;
using test::row;
using test::Values;
using test::valuesOf;

constexpr std::string_view neither = "neither the truth nor the candidate has a boundary";

/// A mask drawn row by row, as `test::row` draws one.
Mask picture(const std::vector<std::string_view>& rows) {
  Mask mask{static_cast<int>(rows.front().size()), static_cast<int>(rows.size()), {}};
  for (const std::string_view line : rows) {
    const Mask one = row(line);
    mask.samples.insert(mask.samples.end(), one.samples.begin(), one.samples.end());
  }
  return mask;
}

std::string_view reasonOf(std::string_view name, const Mask& candidate, const Mask& truth,
                          const SampleLayout& layout = {}) {
  return compareBoundaries(candidate, truth, layout).at(placeOf(name)).reason;
}

// ---- by hand

TEST(Boundaries, ByHandInARow) {
  // One side each, at 4.5 and 2.5. Bands overlap at last in two samples of six.
  expectAlike(valuesOf(row(".....####"), row("...######")),
              {2.0, 2.0, 0.0, 0.0, 2.0 / 6, 0.0, 1.0, 1.0});
  // The truth's second shadow is missed: its sides, at 7.5 and 8.5, are 4 and 5 from that at 3.5.
  expectAlike(valuesOf(row(".###......."), row(".###....#..")),
              {9.0 / 6, 5.0, 2.0 / 3, 3.0 / 4, 3.0 / 4, 4.0 / 6, 4.0 / 6, 5.0 / 6});
}

TEST(Boundaries, ByHandInThePlane) {
  const Mask truth = picture({".....",  //
                              ".##..",  //
                              ".##..",  //
                              "....."});
  const Mask candidate = picture({".....",  //
                                  ".###.",  //
                                  ".###.",  //
                                  "....."});
  // Of 8 and 10 sides, the right-hand ones are 1 apart; the candidate's over and under the third
  // column are √½ from the truth's right-hand ones, and these as far from their own corners.
  const double apart = 2 * std::sqrt(0.5) + 2 * 1 + 2 * std::sqrt(0.5);
  // Every shadowed sample has a side of its own.
  expectAlike(valuesOf(candidate, truth),
              {apart / 18, 1.0, 4.0 / 6, 4.0 / 6, 4.0 / 6, 1.0, 1.0, 1.0});
}

TEST(Boundaries, ThePercentileLeavesOutAtMostATwentieth) {
  // One side in every fiftieth row, the candidate's as many samples off as there are rows before.
  const auto ladder = [](int rows, int shift) {
    Mask mask = drawn(40, 50 * rows, [&](int x, int y) { return x > 5 + shift * (y / 50); });
    for (std::size_t i = 0; i < mask.size(); ++i) {
      if (i / 40 % 50 != 0) mask.samples[i] = Shade::none;
    }
    return mask;
  };
  for (const auto& [rows, expected] : {std::pair(19, 18.0), {20, 18.0}, {21, 19.0}, {30, 28.0}}) {
    const Values found = valuesOf(ladder(rows, 1), ladder(rows, 0));
    EXPECT_EQ(found[placeOf("assd")], (rows - 1) / 2.0) << rows;
    EXPECT_EQ(found[placeOf("hd95")], expected) << rows;
  }
}

TEST(Boundaries, OfAHalfPlaneAndItsShift) {
  for (int k = 0; k <= 6; ++k) {
    const auto plane = [](int shift) {
      return drawn(40, 30, [=](int x, int) { return x >= 15 + shift; });
    };
    for (const double step : {1.0, 0.5}) {
      Values expected = {k * step, k * step};
      for (const double d : boundaryTolerances) {
        const double band = d / step;  // columns
        const double both = std::max(band - k, 0.0);
        expected.emplace_back(both / (2 * band - both));
      }
      for (const double d : boundaryTolerances) expected.emplace_back(k * step <= d ? 1.0 : 0.0);
      expectAlike(valuesOf(plane(k), plane(0), {step, 7.0, 0, {}}), expected);
    }
  }
}

TEST(Boundaries, OfConcentricDiscs) {
  const auto disc = [](double radius) {
    return drawn(201, 201, [=](int x, int y) { return std::hypot(x - 100, y - 100) < radius; });
  };
  const Values found = valuesOf(disc(73), disc(70));
  EXPECT_NEAR(*found[placeOf("assd")], 3, 0.2);
  EXPECT_NEAR(*found[placeOf("hd95")], 3, 0.7);
  EXPECT_EQ(found[placeOf("surface_dice_2")], 0);
  EXPECT_EQ(found[placeOf("surface_dice_4")], 1);
  // Two rings 4 wide, of which one of width 1 is common.
  const auto area = [](double inner, double outer) { return outer * outer - inner * inner; };
  EXPECT_NEAR(*found[placeOf("boundary_iou_4")], area(69, 70) / area(66, 73), 0.03);
}

// ---- what is no boundary

TEST(Boundaries, NeitherEdgeNorSilhouette) {
  const Mask dark = drawn(6, 5, [](int, int) { return true; });
  for (const std::string& name : test::boundaryNames()) {
    EXPECT_EQ(reasonOf(name, dark, dark), neither) << name;
    EXPECT_EQ(reasonOf(name, dark, complement(dark)), neither) << name;
  }
  // A shadowed ball before nothing; of the second row's shadows one ends on the surface.
  EXPECT_EQ(reasonOf("assd", row("  ###  "), row("  ###  ")), neither);
  const Mask half = picture({" ### ",  //
                             " ##. "});
  EXPECT_EQ(valuesOf(half, half)[placeOf("boundary_iou_1")], 1);
  // Where the candidate has no answer, the truth has no contour either.
  EXPECT_EQ(reasonOf("assd", row("## .."), row("##...")), neither);
  EXPECT_EQ(reasonOf("assd", row("##..."), row("## ..")), neither);
}

TEST(Boundaries, NoBreakInTheSurface) {
  const Mask mask = picture({"##..",  //
                             "##.."});
  SampleLayout layout;
  layout.breaks = {0, breakRight, 0, 0, 0, breakRight, 0, 0};
  EXPECT_EQ(reasonOf("hd95", mask, mask, layout), neither);
  layout.breaks = {breakBelow, breakRight, 0, 0, 0, breakBelow, 0, 0};
  EXPECT_EQ(valuesOf(mask, mask, layout)[placeOf("hd95")], 0);
}

TEST(Boundaries, OnlyOneMaskHasSome) {
  const Mask even = row("........");
  const Mask split = row("....####");
  const Values expected = {{}, {}, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  expectAlike(valuesOf(even, split), expected);
  expectAlike(valuesOf(split, even), expected);
  EXPECT_EQ(reasonOf("assd", even, split), "only the truth has a boundary");
  EXPECT_EQ(reasonOf("hd95", split, even), "only the candidate has a boundary");
}

TEST(Boundaries, SamplesMayLieTooFarApartForABand) {
  const Mask mask = row("...####");
  const SampleLayout coarse{3, 3, 0, {}};
  expectAlike(valuesOf(mask, mask, coarse), {0.0, 0.0, {}, 1.0, 1.0, 1.0, 1.0, 1.0});
  EXPECT_EQ(reasonOf("boundary_iou_1", mask, mask, coarse), "no shadow so near a boundary");
}

// ---- tiles

TEST(Boundaries, EndAtTheBordersOfTiles) {
  const Mask mask = drawn(16, 8, [](int x, int) { return x < 8; });
  const SampleLayout tiles{1, 1, 8, {}};
  for (const std::string& name : test::boundaryNames()) {
    EXPECT_EQ(reasonOf(name, mask, mask, tiles), neither) << name;
  }
  // Where the other tile's contour lies means nothing.
  const Mask left = drawn(16, 8, [](int x, int) { return x >= 6; });
  const Mask right = drawn(16, 8, [](int x, int) { return x < 10; });
  EXPECT_EQ(valuesOf(left, right, tiles)[placeOf("surface_dice_2")], 0);
  EXPECT_EQ(valuesOf(left, right)[placeOf("surface_dice_4")], 1);
}

TEST(Boundaries, InTilesOnlyWhereThereIsRoom) {
  // Down the middle of a tile: rows 1 to 6 are at least 1 from its border, 2 to 5 at least 2.
  const Mask truth = drawn(8, 8, [](int x, int) { return x >= 4; });
  Mask candidate = truth;
  candidate.samples[1 * 8 + 4] = Shade::lit;
  const SampleLayout tile{1, 1, 8, {}};
  const Values found = valuesOf(candidate, truth, tile);
  EXPECT_EQ(found[placeOf("surface_dice_2")], 1);
  EXPECT_EQ(found[placeOf("boundary_iou_1")], 5.0 / 7);
  EXPECT_EQ(found[placeOf("boundary_iou_2")], 1);
  EXPECT_EQ(reasonOf("assd", candidate, truth, tile), "neighbouring faces lie apart in this atlas");
  EXPECT_EQ(reasonOf("surface_dice_4", candidate, truth, tile),
            "every boundary is nearer to a face's border");
  EXPECT_EQ(reasonOf("boundary_iou_4", candidate, truth, tile),
            "no shadow so near a boundary, and no nearer to a face's border");
}

// ---- input

TEST(Boundaries, RefuseWhatDoesNotFit) {
  const Mask mask = row("..##");
  EXPECT_THROW((void)compareBoundaries(mask, row("..#")), InputError);
  EXPECT_THROW((void)compareBoundaries(Mask{4, 1, {}}, mask), InputError);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double step : {0.0, -1.0, nan, infinite}) {
    EXPECT_THROW((void)compareBoundaries(mask, mask, {step, 1, 0, {}}), InputError);
    EXPECT_THROW((void)compareBoundaries(mask, mask, {1, step, 0, {}}), InputError);
  }
  EXPECT_THROW((void)compareBoundaries(mask, mask, {1, 1, -1, {}}), InputError);
  EXPECT_THROW((void)compareBoundaries(mask, mask, {1, 1, 0, {0, 0}}), InputError);
}

TEST(Boundaries, OfMasksWithoutSamples) {
  for (const Mask& empty : {Mask{}, Mask{0, 7, {}}, Mask{7, 0, {}}, row("   ")}) {
    for (const Metric& metric : compareBoundaries(empty, empty)) {
      EXPECT_EQ(metric.reason, neither) << metric.name();
      EXPECT_FALSE(metric.value);
    }
  }
}

TEST(Boundaries, CarryTheirNames) {
  const auto metrics = compareBoundaries(row("..##"), row(".###"));
  ASSERT_EQ(metrics.size(), test::boundaryNames().size());
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    EXPECT_EQ(metrics[i].name(), test::boundaryNames()[i]);
    EXPECT_TRUE(metrics[i].value && metrics[i].reason.empty());
  }
}

/// Long stretches alike, with sides at their ends and just beside every 64th column.
TEST(Boundaries, EverySideOfAWideMaskIsOfItsContour) {
  const int width = 200;
  Mask mask{width, 3, {}};
  for (int row = 0; row < mask.height; ++row) {
    for (int column = 0; column < width; ++column) {
      const bool isDark = column == 0 || column == 63 + row || column >= 128 + row;
      const bool isSeen = column != 150;
      mask.samples.push_back(!isSeen ? Shade::none : isDark ? Shade::shadowed : Shade::lit);
    }
  }
  const auto shade = [&](int row, int column) {
    return mask.samples[static_cast<std::size_t>(row * width + column)];
  };
  std::vector<int> sides;
  for (int halfRow = 0; halfRow < 2 * mask.height - 1; ++halfRow) {
    const int below = halfRow % 2;
    for (int column = 0; column < width - 1 + below; ++column) {
      const Shade a = shade(halfRow / 2, column);
      const Shade b = shade(halfRow / 2 + below, column + 1 - below);
      if (a != b && isAnswer(a) && isAnswer(b)) sides.push_back(2 * column + 1 - below);
    }
  }
  EXPECT_EQ(contourOf(mask, mask, {1, 1, 0, {}}).columns, sides);
  EXPECT_GT(sides.size(), 15U);
}

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
