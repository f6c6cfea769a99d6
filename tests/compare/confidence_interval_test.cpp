#include "compare/confidence_interval.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "common/error.h"
#include "compare/masks.h"
#include "compare/random_errors.h"

namespace gnomon::compare {
namespace {

using test::errorMask;
using test::ErrorShape;
using test::RandomFields;

Mask litEverywhere(int width, int height) {
  return {width, height,
          std::vector<Shade>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                             Shade::lit)};
}

/// A mask of independent samples, in the cells of its tiling.
struct Case {
  Tiling tiling;
  BlockErrors cells;
};

Case independentCase(int side, double rate, std::uint64_t seed) {
  const Mask truth = litEverywhere(side, side);
  RandomFields fields(side, 0.1, seed);
  const Mask mask = errorMask(fields.next(), side, ErrorShape::blobs, rate);
  const Tiling tiling = chooseTiling(truth);
  return {tiling, blockErrors(mask, truth, tiling.cellSide)};
}

/// Cells of weight 100 in `side` × `side` blocks, whose wrong parts are given.
template <typename Wrong>
BlockErrors blocksOf(std::size_t side, const Wrong& wrong) {
  BlockErrors cells{{}, std::vector<double>(4 * side * side, 100)};
  for (std::size_t y = 0; y < 2 * side; ++y) {
    for (std::size_t x = 0; x < 2 * side; ++x) cells.wrong.push_back(wrong(x, y));
  }
  return cells;
}

double width(const ConfidenceInterval& confidence) {
  return confidence.interval->high - confidence.interval->low;
}

TEST(Tiling, HasTheLargestBlocksOfWhichThereAreEnough) {
  EXPECT_EQ(chooseTiling(litEverywhere(240, 240)).cellSide, 10);
  EXPECT_EQ(chooseTiling(litEverywhere(240, 240)).columns, 24);
  EXPECT_EQ(chooseTiling(litEverywhere(480, 48)).cellSide, 6);
  EXPECT_EQ(chooseTiling(litEverywhere(480, 48)).columns, 80);
  EXPECT_EQ(chooseTiling(litEverywhere(3, 3)).cellSide, 1);
  EXPECT_EQ(chooseTiling(Mask{}).cellSide, 1);
  EXPECT_EQ(chooseTiling(Mask{}).columns, 1);
}

/// Blocks without a sample, or with hardly any weight, are none.
TEST(Tiling, CountsBlocksByTheirWeight) {
  Mask half = litEverywhere(360, 360);
  std::vector<double> weights(half.size(), 1);
  for (std::size_t i = 0; i < half.size(); ++i) {
    if (i % 360 < 180) half.samples[i] = Shade::none;
    if (i % 360 < 180) weights[i] = 1e-9;
  }
  const int cell = chooseTiling(half).cellSide;
  EXPECT_LE(cell, 10);
  EXPECT_GE(cell, 8);
  EXPECT_EQ(chooseTiling(litEverywhere(360, 360), weights).cellSide, cell);
  EXPECT_THROW(chooseTiling(half, std::vector<double>(7, 1.0)), InputError);
}

/// Tables of Student's distribution, 97.5 %.
TEST(StudentQuantile, IsThatOfTheTables) {
  EXPECT_NEAR(studentQuantile(2), 4.303, 0.04);
  EXPECT_NEAR(studentQuantile(3), 3.182, 0.01);
  EXPECT_NEAR(studentQuantile(5), 2.571, 0.002);
  EXPECT_NEAR(studentQuantile(10), 2.228, 0.001);
  EXPECT_NEAR(studentQuantile(30), 2.042, 0.001);
  EXPECT_NEAR(studentQuantile(1e9), 1.960, 0.001);
}

/// A rate of independent samples has the variance p (1 - p) / n. The interval is wider by Student's
/// t of some ten degrees, and by what the correction's noise adds.
TEST(RateConfidence, OfIndependentSamplesIsThatOfTheBinomial) {
  double ratio = 0;
  constexpr int repeats = 200;
  for (int r = 0; r < repeats; ++r) {
    const Case c = independentCase(144, 0.2, static_cast<std::uint64_t>(r));
    const ConfidenceInterval confidence = rateConfidence(c.cells, c.tiling);
    ASSERT_TRUE(confidence.interval);
    EXPECT_EQ(confidence.blocks, 144U);
    ratio += width(confidence) / 2 / std::sqrt(0.2 * 0.8 / (144 * 144)) / repeats;
  }
  EXPECT_GT(ratio, 1.96);
  EXPECT_LT(ratio, 2.45);
}

TEST(RateConfidence, IsTheSameWhateverTheWeightsScale) {
  Case c = independentCase(64, 0.1, 3);
  const ConfidenceInterval first = rateConfidence(c.cells, c.tiling);
  ASSERT_TRUE(first.interval);
  EXPECT_TRUE(first.interval->holds(c.cells.rate()));
  EXPECT_NEAR(first.interval->low + first.interval->high, 2 * c.cells.rate(), 1e-12);
  for (double& wrong : c.cells.wrong) wrong *= 8;
  for (double& weight : c.cells.weight) weight *= 8;
  const ConfidenceInterval scaled = rateConfidence(c.cells, c.tiling);
  EXPECT_DOUBLE_EQ(scaled.interval->low, first.interval->low);
  EXPECT_DOUBLE_EQ(scaled.interval->high, first.interval->high);
}

/// Rows and columns of background change nothing.
TEST(RateConfidence, DoesNotSeeBackground) {
  const Case c = independentCase(64, 0.1, 4);
  Case larger = c;
  larger.tiling.columns = c.tiling.columns + 4;
  larger.cells = {};
  for (std::size_t i = 0; i < c.cells.wrong.size(); ++i) {
    larger.cells.wrong.push_back(c.cells.wrong[i]);
    larger.cells.weight.push_back(c.cells.weight[i]);
    if ((i + 1) % static_cast<std::size_t>(c.tiling.columns) != 0) continue;
    larger.cells.wrong.insert(larger.cells.wrong.end(), 4, 0);
    larger.cells.weight.insert(larger.cells.weight.end(), 4, 0);
  }
  const ConfidenceInterval plain = rateConfidence(c.cells, c.tiling);
  const ConfidenceInterval same = rateConfidence(larger.cells, larger.tiling);
  EXPECT_EQ(same.blocks, plain.blocks);
  EXPECT_DOUBLE_EQ(same.interval->low, plain.interval->low);
  EXPECT_DOUBLE_EQ(same.interval->high, plain.interval->high);
}

/// Any drift f(x) + g(y) adds to every block alike in all draws: it widens nothing.
TEST(RateConfidence, DoesNotSeeADrift) {
  RandomFields fields(24, 0.1, 5);
  const std::vector<float> noise = fields.next();
  const auto at = [&](std::size_t x, std::size_t y) { return 10 + noise[24 * y + x]; };
  const ConfidenceInterval plain = rateConfidence(blocksOf(12, at), {1, 24});
  const ConfidenceInterval drifting =
      rateConfidence(blocksOf(12,
                              [&](std::size_t x, std::size_t y) {
                                return at(x, y) + 40 * std::exp((static_cast<double>(x) - 24) / 3) +
                                       0.1 * static_cast<double>(y * y);
                              }),
                     {1, 24});
  ASSERT_TRUE(plain.interval);
  EXPECT_NEAR(width(drifting), width(plain), 1e-9);
}

/// s is multiplied by 2 - s(b/2) / s(b), from 1 on: blocks of the same sums, whose cells vary among
/// themselves by as much as gives that ratio. Cells ± a on a checkerboard have the contrast 4 a.
TEST(RateConfidence, IsCorrectedForWhatNeighboursShare) {
  RandomFields fields(12, 0.1, 6);
  const std::vector<float> values = fields.next();
  const auto widthWith = [&](double apart) {
    return width(rateConfidence(blocksOf(12,
                                         [&](std::size_t x, std::size_t y) {
                                           const double sign = (x + y) % 2 == 0 ? 1 : -1;
                                           return 20 + values[12 * (y / 2) + x / 2] + sign * apart;
                                         }),
                                {1, 24}));
  };
  // Cells alike within their block have nothing but the blocks' own corners as contrasts.
  EXPECT_NEAR(widthWith(0) / widthWith(100), largestCorrection, 1e-9);
  EXPECT_NEAR(widthWith(50) / widthWith(100), 1, 1e-9);
  double between = 0;
  for (double apart = 0; apart <= 2; apart += 0.1) {
    const double factor = widthWith(apart) / widthWith(100);
    EXPECT_GE(factor, 1 - 1e-9);
    EXPECT_LE(factor, largestCorrection + 1e-9);
    if (factor > 1.01 && factor < largestCorrection - 0.01) ++between;
  }
  EXPECT_GT(between, 0) << "nothing between the bounds";
}

TEST(RateConfidence, IsCutToWhatARateCanBe) {
  RandomFields fields(12, 0.1, 7);
  const std::vector<float> values = fields.next();
  // A seventh of the blocks hold errors.
  const auto rare = [&](std::size_t x, std::size_t y) {
    const float value = values[12 * (y / 2) + x / 2];
    return value > 1 ? 100 * value / 4 : 0.0;
  };
  const BlockErrors cells = blocksOf(12, rare);
  const ConfidenceInterval confidence = rateConfidence(cells, {1, 24});
  ASSERT_TRUE(confidence.interval);
  EXPECT_GE(confidence.interval->low, 0);
  EXPECT_TRUE(confidence.interval->holds(cells.rate()));
  const BlockErrors most =
      blocksOf(12, [&](std::size_t x, std::size_t y) { return 100 - rare(x, y) / 10; });
  EXPECT_LE(rateConfidence(most, {1, 24}).interval->high, 1);
  const BlockErrors none = blocksOf(12, [](std::size_t, std::size_t) { return 0.0; });
  const BlockErrors halves = blocksOf(
      12, [](std::size_t x, std::size_t y) { return (x / 2 + y / 2) % 2 == 0 ? 100. : 0; });
  const ConfidenceInterval difference = differenceConfidence(halves, none, {1, 24});
  ASSERT_TRUE(difference.interval);
  EXPECT_GE(difference.interval->low, -1);
  EXPECT_LE(difference.interval->high, 1);
}

TEST(RateConfidence, SaysWhyThereIsNone) {
  const BlockErrors few{std::vector<double>(256, 1), std::vector<double>(256, 2)};
  EXPECT_FALSE(rateConfidence(few, {1, 16}).interval);
  EXPECT_EQ(rateConfidence(few, {1, 16}).reason, "the view has too few blocks of samples");
  EXPECT_EQ(rateConfidence(few, {1, 16}).blocks, 64U);
  BlockErrors rare = blocksOf(12, [](std::size_t, std::size_t) { return 0.0; });
  EXPECT_EQ(rateConfidence(rare, {1, 24}).reason, "no block of the view holds an error");
  for (std::size_t i = 0; i < 5; ++i) rare.wrong[60 * i + 2 * i] = 1;
  EXPECT_FALSE(rateConfidence(rare, {1, 24}).interval);
  EXPECT_EQ(rateConfidence(rare, {1, 24}).reason, "too few blocks of the view hold an error");
  rare.wrong[399] = 1;
  EXPECT_TRUE(rateConfidence(rare, {1, 24}).interval);
  EXPECT_EQ(rateConfidence(rare, {1, 24}).reason, "");
  rare.wrong[210] = 90;
  EXPECT_FALSE(rateConfidence(rare, {1, 24}).interval);
  EXPECT_EQ(rateConfidence(rare, {1, 24}).reason,
            "a few blocks of the view hold nearly all errors");
  const BlockErrors alike = blocksOf(12, [](std::size_t, std::size_t) { return 7.0; });
  EXPECT_EQ(rateConfidence(alike, {1, 24}).reason, "every block of the view gives the same");
}

TEST(DifferenceConfidence, TurnsWithTheOrder) {
  const Case a = independentCase(96, 0.2, 6);
  const Case b = independentCase(96, 0.1, 7);
  const ConfidenceInterval there = differenceConfidence(a.cells, b.cells, a.tiling);
  const ConfidenceInterval back = differenceConfidence(b.cells, a.cells, a.tiling);
  EXPECT_NEAR(back.interval->low, -there.interval->high, 1e-12);
  EXPECT_NEAR(back.interval->high, -there.interval->low, 1e-12);
  EXPECT_TRUE(there.interval->holds(a.cells.rate() - b.cells.rate()));
  EXPECT_FALSE(there.interval->holds(0));
}

/// What both get wrong cancels: a block's own share of errors, however large.
TEST(DifferenceConfidence, DoesNotSeeWhatBothGetWrong) {
  const Case a = independentCase(96, 0.1, 8);
  const Case b = independentCase(96, 0.1, 9);
  Case first = a;
  Case second = b;
  for (std::size_t i = 0; i < a.cells.wrong.size(); ++i) {
    const double both = static_cast<double>(i * i % 7) * 2;
    first.cells.wrong[i] += both;
    second.cells.wrong[i] += both;
  }
  const ConfidenceInterval plain = differenceConfidence(a.cells, b.cells, a.tiling);
  const ConfidenceInterval same = differenceConfidence(first.cells, second.cells, a.tiling);
  EXPECT_NEAR(same.interval->low, plain.interval->low, 1e-12);
  EXPECT_NEAR(same.interval->high, plain.interval->high, 1e-12);
  EXPECT_GT(width(rateConfidence(first.cells, a.tiling)), 2 * width(same));
}

/// Each rate is over its own samples: doubling the weights of one, wrong or not, changes nothing.
TEST(DifferenceConfidence, TakesEachRateOverItsOwnSamples) {
  const Case a = independentCase(96, 0.1, 10);
  const Case b = independentCase(96, 0.1, 11);
  Case doubled = b;
  for (double& wrong : doubled.cells.wrong) wrong *= 2;
  for (double& weight : doubled.cells.weight) weight *= 2;
  const ConfidenceInterval plain = differenceConfidence(a.cells, b.cells, a.tiling);
  const ConfidenceInterval same = differenceConfidence(a.cells, doubled.cells, a.tiling);
  EXPECT_NEAR(same.interval->low, plain.interval->low, 1e-12);
  EXPECT_NEAR(same.interval->high, plain.interval->high, 1e-12);
}

/// An interval of no width would say that another draw of the bumps could not differ either.
TEST(DifferenceConfidence, OfEqualsIsRefused) {
  const Case a = independentCase(64, 0.1, 12);
  const ConfidenceInterval same = differenceConfidence(a.cells, a.cells, a.tiling);
  EXPECT_FALSE(same.interval);
  EXPECT_TRUE(same.areEqual);
  EXPECT_EQ(same.reason, "both give the same answers");
  // Other answers, as many of them wrong.
  Case other = a;
  other.cells.answers = a.cells.answers + 1;
  EXPECT_FALSE(differenceConfidence(a.cells, other.cells, a.tiling).areEqual);
  EXPECT_EQ(differenceConfidence(a.cells, other.cells, a.tiling).reason,
            "no block of the view differs");
  const BlockErrors few{std::vector<double>(256, 1), std::vector<double>(256, 2)};
  EXPECT_EQ(differenceConfidence(few, few, {1, 16}).reason,
            "the view has too few blocks of samples");
}

// ---- the random signs

/// 12 × 12 blocks, of which the first so many differ by these parts of all weight, in the first of
/// their cells or in all four.
ConfidenceInterval ofParts(const std::vector<double>& parts, bool inAllCells = true) {
  const BlockErrors none = blocksOf(12, [](std::size_t, std::size_t) { return 0.0; });
  const BlockErrors some = blocksOf(12, [&](std::size_t x, std::size_t y) {
    // Far apart, as neighbours would be one place.
    const std::size_t block = y / 2 * 12 + x / 2;
    const std::size_t k = block / 11;
    if (block % 11 != 0 || k >= parts.size()) return 0.0;
    const double whole = parts[k] * 100 * 576;
    return inAllCells ? whole / 4 : x % 2 + y % 2 == 0 ? whole : 0;
  });
  return differenceConfidence(some, none, {1, 24});
}

/// With few blocks all choices of signs can be made: 5 in 100 of them reach half the width. One
/// block holds so much that differences of neighbours have no degrees of freedom.
TEST(RandomSigns, HaveTheHalfWidthThatOneChoiceInTwentyReaches) {
  const std::vector<double> parts = {0.004,  0.0004, 0.0003, 0.0005,  -0.0002,
                                     0.0006, 0.0001, 0.0007, 0.00035, -0.00045};
  const ConfidenceInterval confidence = ofParts(parts, false);
  ASSERT_TRUE(confidence.interval) << confidence.reason;
  const double half = width(confidence) / 2;
  int reached = 0;
  constexpr unsigned choices = 1U << 10U;
  for (unsigned choice = 0; choice < choices; ++choice) {
    double sum = 0;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      sum += (choice >> k & 1U) != 0 ? parts[k] : -parts[k];
    }
    reached += std::abs(sum) >= half * (1 - 1e-6) ? 1 : 0;
  }
  EXPECT_GE(reached, 0.04 * choices);
  EXPECT_LE(reached, 0.06 * choices);
  // In single cells nothing is cut by a border; spread over all four, all may be.
  EXPECT_NEAR(width(ofParts(parts)), largestCorrection * width(confidence), 1e-12);
}

/// All signs of five blocks agree in 2 of 32 choices, of six in 2 of 64. One block holds so much
/// that Student's t is refused.
TEST(RandomSigns, NeverDecideByFiveBlocks) {
  for (std::size_t blocks = 1; blocks <= 9; ++blocks) {
    std::vector<double> parts(blocks, 0.0006);
    parts[0] = 0.008;
    const ConfidenceInterval confidence = ofParts(parts, false);
    ASSERT_TRUE(confidence.interval) << blocks;
    EXPECT_TRUE(confidence.interval->holds(0.0006 * static_cast<double>(blocks) + 0.0074));
    EXPECT_EQ(confidence.interval->holds(0), blocks <= 5) << blocks;
    for (double& part : parts) part = -part;
    EXPECT_EQ(ofParts(parts, false).interval->holds(0), blocks <= 5) << blocks;
  }
}

/// One place alone, however large, may be chance.
TEST(RandomSigns, OneLargeBlockIsNoEvidence) {
  EXPECT_TRUE(ofParts({0.02}).interval->holds(0));
  EXPECT_TRUE(ofParts({0.006, -0.00001, 0.00001}).interval->holds(0));
}

TEST(DifferenceConfidence, RefusesWhatIsNotOneView) {
  const Case a = independentCase(64, 0.1, 13);
  EXPECT_THROW(rateConfidence(a.cells, {1, 5}), InternalError);
  EXPECT_THROW(rateConfidence(a.cells, {1, 0}), InternalError);
  const BlockErrors other{std::vector<double>(8, 1), std::vector<double>(8, 2)};
  EXPECT_THROW(differenceConfidence(a.cells, other, a.tiling), InternalError);
}

}  // namespace
}  // namespace gnomon::compare
