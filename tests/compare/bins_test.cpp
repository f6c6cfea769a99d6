#include "compare/bins.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "common/error.h"
#include "compare/masks.h"

namespace gnomon::compare {
namespace {

using test::row;

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(BinOf, HoldsItsLowerEdgeButNotItsUpper) {
  const std::vector<double> edges = {-1, 0, 2.5};
  EXPECT_EQ(binOf(-infinity, edges), 0);
  EXPECT_EQ(binOf(-1.0001, edges), 0);
  EXPECT_EQ(binOf(-1, edges), 1);
  EXPECT_EQ(binOf(-1e-300, edges), 1);
  EXPECT_EQ(binOf(0, edges), 2);
  EXPECT_EQ(binOf(2.5, edges), 3);
  EXPECT_EQ(binOf(infinity, edges), 3);
  EXPECT_EQ(binOf(std::nan(""), edges), noBin);
  EXPECT_EQ(binOf(7, {}), 0);
}

TEST(RequireEdges, RefusesEdgesThatDoNotRise) {
  EXPECT_THROW(requireEdges(std::vector<double>{1, 1}), InternalError);
  EXPECT_THROW(requireEdges(std::vector<double>{2, 1}), InternalError);
  std::vector<double> many(255);
  for (std::size_t i = 0; i < many.size(); ++i) many[i] = static_cast<double>(i);
  EXPECT_THROW(requireEdges(many), InternalError);
  many.pop_back();
  EXPECT_NO_THROW(requireEdges(many));
  EXPECT_EQ(binOf(1000, many), 254);
}

TEST(CountBins, CountsEachSampleInItsBin) {
  const Mask truth = row(".##. #");
  const Mask mask = row("..## #");
  const std::vector<std::uint8_t> bins = {0, 2, 2, 0, noBin, noBin};
  const std::vector<double> weights = {1, 2, 4, 8, 16, 32};
  const std::vector<Counts> counts = countBins(mask, truth, bins, 3, weights);
  ASSERT_EQ(counts.size(), 3U);
  EXPECT_EQ(counts[0].trueNegative, 1);
  EXPECT_EQ(counts[0].falsePositive, 8);
  EXPECT_EQ(counts[0].samples, 2U);
  EXPECT_EQ(counts[1].samples, 0U);
  EXPECT_EQ(counts[2].falseNegative, 2);
  EXPECT_EQ(counts[2].truePositive, 4);
  EXPECT_EQ(counts[2].total(), 6);
  EXPECT_EQ(countBins(mask, truth, bins, 3)[0].falsePositive, 1);
}

/// A bin's counts are those of countSamples with the bin selected.
TEST(CountBins, IsCountSamplesOfEachBin) {
  rc::check([] {
    test::Comparison c = test::arbitraryComparison();
    std::vector<std::uint8_t> bins(c.truth.size());
    for (std::uint8_t& bin : bins) {
      bin = *rc::gen::inRange<std::uint8_t>(0, 5);
      if (bin == 4) bin = noBin;
    }
    const std::vector<Counts> counts = countBins(c.candidate, c.truth, bins, 4, c.weights);
    for (std::uint8_t bin = 0; bin < 4; ++bin) {
      for (std::size_t i = 0; i < bins.size(); ++i) c.selected[i] = bins[i] == bin ? 1 : 0;
      const Counts expected = countSamples(c.candidate, c.truth, c.weights, c.selected);
      const double error = 1e-12 * expected.total();
      RC_ASSERT(counts[bin].samples == expected.samples);
      RC_ASSERT(std::abs(counts[bin].truePositive - expected.truePositive) <= error);
      RC_ASSERT(std::abs(counts[bin].falsePositive - expected.falsePositive) <= error);
      RC_ASSERT(std::abs(counts[bin].falseNegative - expected.falseNegative) <= error);
      RC_ASSERT(std::abs(counts[bin].trueNegative - expected.trueNegative) <= error);
    }
  });
}

TEST(CountBins, RefusesWhatCannotBeCounted) {
  const std::vector<std::uint8_t> bins = {0, 0};
  EXPECT_THROW(countBins(row(".."), row("..."), bins, 1), InputError);
  EXPECT_THROW(countBins(row("..."), row("..."), bins, 1), InputError);
  EXPECT_THROW(countBins(row(". "), row(".."), bins, 1), InputError);
  EXPECT_THROW(countBins(row(".."), row(".."), bins, 1, std::vector<double>{1}), InputError);
  EXPECT_THROW(countBins(row(".."), row(".."), std::vector<std::uint8_t>{0, 1}, 1), InternalError);
}

}  // namespace
}  // namespace gnomon::compare
