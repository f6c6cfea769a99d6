#include "compare/block_errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "common/error.h"
#include "compare/counts.h"
#include "compare/masks.h"

namespace gnomon::compare {
namespace {

using test::row;

TEST(BlockErrors, AreTheWrongSamplesOfEveryTile) {
  // 5 × 3 samples in tiles of 2: three columns and two rows of them.
  const Mask truth{5, 3, std::vector<Shade>(15, Shade::lit)};
  Mask mask = truth;
  for (const std::size_t i : {0U, 6U, 4U, 14U}) mask.samples[i] = Shade::shadowed;
  const BlockErrors errors = blockErrors(mask, truth, 2);
  EXPECT_EQ(errors.wrong, (std::vector<double>{2, 0, 1, 0, 0, 1}));
  EXPECT_EQ(errors.weight, (std::vector<double>{4, 4, 2, 2, 2, 1}));
  EXPECT_DOUBLE_EQ(errors.rate(), 4.0 / 15);
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
  EXPECT_EQ(blockErrors(row("   ##"), row("   .."), 3).weight, (std::vector<double>{0, 2}));
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

/// As many wrong samples in every block are not the same answers.
TEST(BlockErrors, KnowTheSameAnswers) {
  const Mask truth{4, 4, std::vector<Shade>(16, Shade::lit)};
  Mask mask = truth;
  mask.samples[1] = Shade::shadowed;
  const BlockErrors one = blockErrors(mask, truth, 2);
  EXPECT_TRUE(one.answersAlike(blockErrors(mask, truth, 2)));
  std::swap(mask.samples[1], mask.samples[4]);
  BlockErrors other = blockErrors(mask, truth, 2);
  EXPECT_EQ(other.wrong, one.wrong);
  EXPECT_FALSE(other.answersAlike(one));
  // One light of two differs.
  BlockErrors both = one;
  both += one;
  other += one;
  EXPECT_FALSE(both.answersAlike(other));
  other = one;
  other += one;
  EXPECT_TRUE(both.answersAlike(other));
  EXPECT_FALSE(BlockErrors{}.answersAlike(BlockErrors{})) << "of what is not known nothing is";
  // Shares: as far off, to the other side.
  const Visibility half{2, 1, {0.5F, 0.5F}};
  const BlockErrors more = blockErrors(Visibility{2, 1, {0.75F, 0.5F}}, half, 1);
  const BlockErrors less = blockErrors(Visibility{2, 1, {0.25F, 0.5F}}, half, 1);
  EXPECT_EQ(more.wrong, less.wrong);
  EXPECT_FALSE(more.answersAlike(less));
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

}  // namespace
}  // namespace gnomon::compare
