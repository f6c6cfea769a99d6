#include "compare/block_bootstrap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "common/error.h"
#include "compare/counts.h"
#include "compare/masks.h"

namespace gnomon {
namespace {

using test::row;

/// Two masks over a truth that is lit everywhere: each sample wrong in one, the other, both or none
/// by chance, independently of its neighbours.
struct Pair {
  Mask before, after, truth;
};

Pair independentPair(int width, int height, double onlyBefore, double onlyAfter, double both) {
  Pair pair;
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < width * height; ++i) {
    const double u = uniform(generator);
    const bool inBoth = u < both;
    const bool first = inBoth || (u >= both && u < both + onlyBefore);
    const bool second = inBoth || (u >= both + onlyBefore && u < both + onlyBefore + onlyAfter);
    pair.before.samples.push_back(first ? Shade::shadowed : Shade::lit);
    pair.after.samples.push_back(second ? Shade::shadowed : Shade::lit);
    pair.truth.samples.push_back(Shade::lit);
  }
  for (Mask* mask : {&pair.before, &pair.after, &pair.truth}) {
    mask->width = width;
    mask->height = height;
  }
  return pair;
}

double width(const Interval& interval) {
  return interval.high - interval.low;
}

TEST(BlockErrors, AreTheWrongSamplesOfEveryTile) {
  // 5 × 3 samples in tiles of 2: three columns and two rows of them.
  const Mask truth{5, 3, std::vector<Shade>(15, Shade::lit)};
  Mask mask = truth;
  for (const std::size_t i : {0U, 6U, 4U, 14U}) mask.samples[i] = Shade::shadowed;
  const BlockErrors errors = blockErrors(mask, truth, 2);
  EXPECT_EQ(errors.wrong, (std::vector<double>{2, 0, 1, 0, 0, 1}));
  EXPECT_EQ(errors.weight, (std::vector<double>{4, 4, 2, 2, 2, 1}));
  EXPECT_DOUBLE_EQ(errors.rate(), 4.0 / 15);
  EXPECT_EQ(errors.count(), 6U);
}

TEST(BlockErrors, HoldWeightsSelectionsAndNoBackground) {
  const Mask truth = row("..#  .");
  const Mask mask = row("#..  #");
  const std::vector<double> weights = {1, 2, 4, 8, 16, 32};
  const std::vector<std::uint8_t> selected = {1, 1, 0, 1, 1, 1};
  const BlockErrors all = blockErrors(mask, truth, 3, weights);
  EXPECT_EQ(all.wrong, (std::vector<double>{5, 32}));
  EXPECT_EQ(all.weight, (std::vector<double>{7, 32}));
  const BlockErrors some = blockErrors(mask, truth, 3, weights, selected);
  EXPECT_EQ(some.wrong, (std::vector<double>{1, 32}));
  EXPECT_EQ(some.weight, all.weight);
  EXPECT_EQ(blockErrors(row("   ##"), row("   .."), 3).count(), 1U);
}

TEST(BlockErrors, RefuseWhatCannotBeCompared) {
  EXPECT_THROW(blockErrors(row(".."), row("..."), 2), InputError);
  EXPECT_THROW(blockErrors(row(".."), row(". "), 2), InputError);
  EXPECT_THROW(blockErrors(row(".."), row(".."), 2, std::vector<double>{1}), InputError);
  EXPECT_THROW(blockErrors(row(".."), row(".."), 2, {}, std::vector<std::uint8_t>{1}), InputError);
  EXPECT_THROW(blockErrors(row(".."), row(".."), 0), InternalError);
  BlockErrors one = blockErrors(row(".."), row(".."), 1);
  EXPECT_THROW(one += blockErrors(row("..."), row("..."), 1), InternalError);
}

/// The rate of any tiling is that of countSamples, whatever the tiles.
TEST(BlockErrors, AddUpToTheCounts) {
  rc::check([] {
    const test::Comparison c = test::arbitraryComparison();
    const int side = *rc::gen::inRange(1, 60);
    const Counts counts = countSamples(c.candidate, c.truth, c.weights);
    const BlockErrors errors = blockErrors(c.candidate, c.truth, side, c.weights);
    const double wrong = std::accumulate(errors.wrong.begin(), errors.wrong.end(), 0.0);
    const double weight = std::accumulate(errors.weight.begin(), errors.weight.end(), 0.0);
    RC_ASSERT(std::abs(wrong - counts.falsePositive - counts.falseNegative) <=
              1e-12 * counts.total());
    RC_ASSERT(std::abs(weight - counts.total()) <= 1e-12 * counts.total());
  });
}

/// A rate of independent samples has the variance p (1 - p) / n.
TEST(BlockBootstrap, OfSingleSamplesGivesTheBinomialInterval) {
  const Pair pair = independentPair(100, 60, 0.08, 0, 0);
  const BlockErrors errors = blockErrors(pair.before, pair.truth, 1);
  const double p = errors.rate();
  const double half = 1.959964 * std::sqrt(p * (1 - p) / 6000);
  const Interval interval = rateInterval(errors, {4000, 0.95, 3});
  EXPECT_NEAR(interval.low, p - half, 0.08 * half);
  EXPECT_NEAR(interval.high, p + half, 0.08 * half);
}

/// A paired difference of independent samples has the variance (a + b - (a - b)²) / n, a and b
/// being the shares that only the one and only the other gets wrong: what both get wrong cancels.
TEST(BlockBootstrap, OfPairsGivesMcNemarsInterval) {
  for (const double both : {0.0, 0.3}) {
    const Pair pair = independentPair(100, 60, 0.06, 0.02, both);
    const BlockErrors before = blockErrors(pair.before, pair.truth, 1);
    const BlockErrors after = blockErrors(pair.after, pair.truth, 1);
    double a = 0;
    double b = 0;
    for (std::size_t i = 0; i < 6000; ++i) {
      if (before.wrong[i] > after.wrong[i]) a += 1.0 / 6000;
      if (before.wrong[i] < after.wrong[i]) b += 1.0 / 6000;
    }
    const double half = 1.959964 * std::sqrt((a + b - (a - b) * (a - b)) / 6000);
    const Interval interval = differenceInterval(before, after, {4000, 0.95, 3});
    EXPECT_NEAR(interval.low, a - b - half, 0.08 * half) << both;
    EXPECT_NEAR(interval.high, a - b + half, 0.08 * half) << both;
  }
}

/// Where whole tiles err together, a tile is one observation: the interval is as wide as that of as
/// many samples as there are tiles.
TEST(BlockBootstrap, WidensWhereNeighboursErrTogether) {
  const Pair few = independentPair(20, 20, 0.2, 0, 0);
  Mask mask{200, 200, std::vector<Shade>(40000)};
  for (std::size_t i = 0; i < mask.size(); ++i) {
    mask.samples[i] = few.before.samples[i / 200 / 10 * 20 + i % 200 / 10];
  }
  const Mask truth{200, 200, std::vector<Shade>(40000, Shade::lit)};
  const Interval tiles = rateInterval(blockErrors(mask, truth, 10));
  const Interval samples = rateInterval(blockErrors(mask, truth, 1));
  const Interval coarse = rateInterval(blockErrors(few.before, few.truth, 1));
  EXPECT_DOUBLE_EQ(tiles.low, coarse.low);
  EXPECT_DOUBLE_EQ(tiles.high, coarse.high);
  EXPECT_NEAR(width(tiles) / width(samples), 10, 1.5);
}

TEST(BlockBootstrap, IsTheSameEachTimeAndTurnsWithTheOrder) {
  const Pair pair = independentPair(64, 64, 0.05, 0.03, 0.1);
  const BlockErrors before = blockErrors(pair.before, pair.truth, 8);
  const BlockErrors after = blockErrors(pair.after, pair.truth, 8);
  const Interval first = differenceInterval(before, after);
  const Interval again = differenceInterval(before, after);
  EXPECT_EQ(first.low, again.low);
  EXPECT_EQ(first.high, again.high);
  const Interval turned = differenceInterval(after, before);
  EXPECT_NEAR(turned.low, -first.high, 1e-12);
  EXPECT_NEAR(turned.high, -first.low, 1e-12);
  EXPECT_LT(first.low, before.rate() - after.rate());
  EXPECT_GT(first.high, before.rate() - after.rate());
  EXPECT_GT(width(differenceInterval(before, after, {1000, 0.99, 1978})), width(first));
  EXPECT_NE(differenceInterval(before, after, {1000, 0.95, 1}).low, first.low);
}

TEST(BlockBootstrap, DoesNotDependOnTheScaleOfWeightsOrOnEmptyBlocks) {
  const Pair pair = independentPair(60, 60, 0.05, 0.03, 0.1);
  const BlockErrors before = blockErrors(pair.before, pair.truth, 6);
  const BlockErrors after = blockErrors(pair.after, pair.truth, 6);
  const auto changed = [](BlockErrors errors) {
    for (double& w : errors.wrong) w *= 8;
    for (double& w : errors.weight) w *= 8;
    for (std::vector<double>* list : {&errors.wrong, &errors.weight})
      list->insert(list->begin() + 3, 0);
    return errors;
  };
  const Interval plain = differenceInterval(before, after);
  const Interval same = differenceInterval(changed(before), changed(after));
  EXPECT_DOUBLE_EQ(plain.low, same.low);
  EXPECT_DOUBLE_EQ(plain.high, same.high);
}

TEST(BlockBootstrap, OfNoDifferenceIsNone) {
  const Pair pair = independentPair(40, 40, 0.2, 0.1, 0);
  const BlockErrors errors = blockErrors(pair.before, pair.truth, 4);
  const Interval interval = differenceInterval(errors, errors);
  EXPECT_EQ(interval.low, 0);
  EXPECT_EQ(interval.high, 0);
  EXPECT_TRUE(interval.holds(0));
  EXPECT_FALSE(interval.holds(1e-9));
}

TEST(BlockBootstrap, RefusesWhatGivesNoInterval) {
  const BlockErrors one{{1, 0}, {2, 0}};
  EXPECT_THROW(rateInterval(one), InternalError);
  const BlockErrors two{{1, 0}, {2, 2}};
  EXPECT_THROW(rateInterval(two, {0, 0.95, 1}), InternalError);
  EXPECT_THROW(rateInterval(two, {100, 1, 1}), InternalError);
  EXPECT_THROW(differenceInterval(two, {{1}, {2}}), InternalError);
}

}  // namespace
}  // namespace gnomon
