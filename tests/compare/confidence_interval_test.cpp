#include "compare/confidence_interval.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "common/error.h"
#include "compare/masks.h"
#include "compare/random_errors.h"

namespace gnomon {
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

double width(const ConfidenceInterval& confidence) {
  return confidence.interval->high - confidence.interval->low;
}

TEST(Tiling, HasTheLargestBlocksOfWhichThereAreSixteen) {
  EXPECT_EQ(chooseTiling(litEverywhere(120, 120)).cellSide, 15);
  EXPECT_EQ(chooseTiling(litEverywhere(120, 120)).columns, 8);
  EXPECT_EQ(chooseTiling(litEverywhere(121, 7)).cellSide, 3);
  EXPECT_EQ(chooseTiling(litEverywhere(121, 7)).columns, 41);
  EXPECT_EQ(chooseTiling(litEverywhere(3, 3)).cellSide, 1);
  EXPECT_EQ(chooseTiling(Mask{}).cellSide, 1);
  EXPECT_EQ(chooseTiling(Mask{}).columns, 1);
}

/// Blocks without a sample, or with hardly any weight, are none.
TEST(Tiling, CountsBlocksByTheirWeight) {
  Mask half = litEverywhere(160, 160);
  std::vector<double> weights(half.size(), 1);
  for (std::size_t i = 0; i < half.size(); ++i) {
    if (i % 160 < 80) half.samples[i] = Shade::none;
    if (i % 160 < 80) weights[i] = 1e-9;
  }
  const int cell = chooseTiling(half).cellSide;
  EXPECT_LE(cell, 14);
  EXPECT_GE(cell, 10);
  EXPECT_EQ(chooseTiling(litEverywhere(160, 160), weights).cellSide, cell);
  EXPECT_THROW(chooseTiling(half, std::vector<double>(7, 1.0)), InputError);
}

/// A rate of independent samples has the variance p (1 - p) / n, and with 16 blocks to tell it by,
/// the interval is that of Student's t; wider by what the correction's noise adds.
TEST(RateConfidence, OfIndependentSamplesIsStudentsT) {
  double ratio = 0;
  constexpr int repeats = 200;
  for (int r = 0; r < repeats; ++r) {
    const Case c = independentCase(96, 0.2, static_cast<std::uint64_t>(r));
    const ConfidenceInterval confidence = rateConfidence(c.cells, c.tiling);
    ASSERT_TRUE(confidence.interval);
    EXPECT_EQ(confidence.blocks, 16U);
    ratio += width(confidence) / 2 / std::sqrt(0.2 * 0.8 / (96 * 96)) / repeats;
  }
  EXPECT_GT(ratio, 2.131);  // t of 15 degrees of freedom, 97.5 %
  EXPECT_LT(ratio, 2.131 * 1.12);
}

TEST(RateConfidence, IsTheSameWhereDrawsAreShared) {
  const Bootstrap shared;
  for (const int cells : {16, 8, 12, 16}) {  // a side: other numbers of blocks
    const Mask truth = litEverywhere(96, 96);
    RandomFields fields(96, 0.1, 5);
    const Mask mask = errorMask(fields.next(), 96, ErrorShape::blobs, 0.1);
    const BlockErrors errors = blockErrors(mask, truth, 96 / cells);
    const Tiling tiling{96 / cells, cells};
    const ConfidenceInterval own = rateConfidence(errors, tiling);
    const ConfidenceInterval same = rateConfidence(errors, tiling, shared);
    ASSERT_TRUE(own.interval);
    EXPECT_EQ(own.interval->low, same.interval->low);
    EXPECT_EQ(own.interval->high, same.interval->high);
  }
}

TEST(RateConfidence, IsTheSameEachTimeAndWhateverTheWeightsScale) {
  Case c = independentCase(64, 0.1, 3);
  const ConfidenceInterval first = rateConfidence(c.cells, c.tiling);
  const ConfidenceInterval again = rateConfidence(c.cells, c.tiling);
  EXPECT_EQ(first.interval->low, again.interval->low);
  EXPECT_EQ(first.interval->high, again.interval->high);
  EXPECT_TRUE(first.interval->holds(c.cells.rate()));
  for (double& wrong : c.cells.wrong) wrong *= 8;
  for (double& weight : c.cells.weight) weight *= 8;
  const ConfidenceInterval scaled = rateConfidence(c.cells, c.tiling);
  EXPECT_DOUBLE_EQ(scaled.interval->low, first.interval->low);
  EXPECT_DOUBLE_EQ(scaled.interval->high, first.interval->high);
  EXPECT_GT(width(rateConfidence(c.cells, c.tiling, Bootstrap({1000, 0.99, 1978}))), width(first));
  EXPECT_NE(rateConfidence(c.cells, c.tiling, Bootstrap({1000, 0.95, 1})).interval->low,
            first.interval->low);
}

/// Rows and columns of background change nothing: empty blocks are not drawn.
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
  EXPECT_EQ(same.interval->low, plain.interval->low);
  EXPECT_EQ(same.interval->high, plain.interval->high);
}

/// s is multiplied by 2 - s(b/2) / s(b), from 1 to 1.3: blocks of the same sums, whose cells vary
/// among themselves by as much as gives that ratio.
TEST(RateConfidence, IsCorrectedForWhatNeighboursShare) {
  constexpr std::size_t blocks = 64;
  RandomFields fields(8, 0.1, 5);
  const std::vector<float> values = fields.next();
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / blocks;
  double squares = 0;
  for (const float value : values) squares += std::pow(value - mean, 2);
  const auto widthOf = [&](double ratio) {
    // s(b)² = 64/63 Σ D², s(b/2)² = 256/255 Σ (D²/4 + 4 a²): a, for the ratio of the two.
    const double wanted = ratio * ratio * squares * (64.0 / 63) / (256.0 / 255);
    const double apart = std::sqrt(std::max(0.0, wanted - squares / 4) / (4 * blocks));
    BlockErrors cells{std::vector<double>(4 * blocks), std::vector<double>(4 * blocks, 100)};
    for (std::size_t y = 0; y < 16; ++y) {
      for (std::size_t x = 0; x < 16; ++x) {
        const double sign = (x + y) % 2 == 0 ? 1 : -1;
        cells.wrong[16 * y + x] =
            20 + static_cast<double>(values[8 * (y / 2) + x / 2]) / 4 + sign * apart;
      }
    }
    return width(rateConfidence(cells, {1, 16}));
  };
  EXPECT_NEAR(widthOf(0.85) / widthOf(1), 1.15, 1e-9);
  EXPECT_NEAR(widthOf(0.75) / widthOf(1), 1.25, 1e-9);
  EXPECT_NEAR(widthOf(0.6) / widthOf(1), largestCorrection, 1e-9);
  EXPECT_NEAR(widthOf(1.3) / widthOf(1), 1, 1e-9);
}

TEST(RateConfidence, IsCutToWhatARateCanBe) {
  // Six of sixteen blocks err a little, one a lot: θ - s t* falls below 0.
  BlockErrors cells{std::vector<double>(64), std::vector<double>(64, 1)};
  for (std::size_t i = 0; i < 6; ++i) cells.wrong[2 * i + 16 * (i / 4)] = i == 0 ? 1 : 0.001;
  const ConfidenceInterval confidence = rateConfidence(cells, {1, 8});
  ASSERT_TRUE(confidence.interval);
  EXPECT_GE(confidence.interval->low, 0);
  EXPECT_LE(confidence.interval->high, 1);
  EXPECT_TRUE(confidence.interval->holds(cells.rate()));
}

TEST(RateConfidence, SaysWhyThereIsNone) {
  const BlockErrors few{std::vector<double>(36, 1), std::vector<double>(36, 2)};
  EXPECT_FALSE(rateConfidence(few, {1, 6}).interval);
  EXPECT_EQ(rateConfidence(few, {1, 6}).reason, "the view has too few blocks of samples");
  EXPECT_EQ(rateConfidence(few, {1, 6}).blocks, 9U);
  BlockErrors rare{std::vector<double>(64), std::vector<double>(64, 2)};
  EXPECT_EQ(rateConfidence(rare, {1, 8}).reason, "too few blocks of the view hold an error");
  for (std::size_t i = 0; i < 5; ++i) rare.wrong[2 * i + 16 * (i / 4)] = 1;
  EXPECT_FALSE(rateConfidence(rare, {1, 8}).interval);
  EXPECT_EQ(rateConfidence(rare, {1, 8}).reason, "too few blocks of the view hold an error");
  rare.wrong[40] = 1;
  EXPECT_TRUE(rateConfidence(rare, {1, 8}).interval);
  EXPECT_EQ(rateConfidence(rare, {1, 8}).reason, "");
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
    const double both = static_cast<double>(i % 7) * 10;
    first.cells.wrong[i] += both;
    second.cells.wrong[i] += both;
  }
  const ConfidenceInterval plain = differenceConfidence(a.cells, b.cells, a.tiling);
  const ConfidenceInterval same = differenceConfidence(first.cells, second.cells, a.tiling);
  EXPECT_NEAR(same.interval->low, plain.interval->low, 1e-12);
  EXPECT_NEAR(same.interval->high, plain.interval->high, 1e-12);
  EXPECT_GT(width(rateConfidence(first.cells, a.tiling)), 3 * width(same));
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

TEST(DifferenceConfidence, OfEqualsIsNoneAtAll) {
  const Case a = independentCase(64, 0.1, 12);
  const ConfidenceInterval confidence = differenceConfidence(a.cells, a.cells, a.tiling);
  ASSERT_TRUE(confidence.interval);
  EXPECT_EQ(confidence.interval->low, 0);
  EXPECT_EQ(confidence.interval->high, 0);
  Case other = a;
  other.cells.wrong[3] += 1;
  EXPECT_EQ(differenceConfidence(a.cells, other.cells, a.tiling).reason,
            "too few blocks of the view differ");
}

TEST(DifferenceConfidence, RefusesWhatIsNotOneView) {
  const Case a = independentCase(64, 0.1, 13);
  EXPECT_THROW(rateConfidence(a.cells, {1, 5}), InternalError);
  EXPECT_THROW(rateConfidence(a.cells, {1, 0}), InternalError);
  EXPECT_THROW(rateConfidence(a.cells, a.tiling, Bootstrap({0, 0.95, 1})), InternalError);
  EXPECT_THROW(rateConfidence(a.cells, a.tiling, Bootstrap({100, 1, 1})), InternalError);
  const BlockErrors other{std::vector<double>(8, 1), std::vector<double>(8, 2)};
  EXPECT_THROW(differenceConfidence(a.cells, other, a.tiling), InternalError);
}

}  // namespace
}  // namespace gnomon
