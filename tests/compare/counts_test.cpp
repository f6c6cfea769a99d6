#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "common/error.h"
#include "compare/answer_metrics.h"
#include "compare/confidence_interval.h"
#include "compare/counts.h"
#include "compare/masks.h"
#include "support/error_messages.h"

namespace gnomon::compare {
namespace {

using test::arbitraryComparison;
using test::Comparison;
using test::complement;
using test::row;

void expectCells(const Counts& c, double tp, double fp, double fn, double tn, std::size_t samples) {
  EXPECT_EQ(c.truePositive, tp);
  EXPECT_EQ(c.falsePositive, fp);
  EXPECT_EQ(c.falseNegative, fn);
  EXPECT_EQ(c.trueNegative, tn);
  EXPECT_EQ(c.samples, samples);
}

bool sameBits(const Counts& a, const Counts& b) {
  return a.truePositive == b.truePositive && a.falsePositive == b.falsePositive &&
         a.falseNegative == b.falseNegative && a.trueNegative == b.trueNegative &&
         a.samples == b.samples;
}

TEST(Counts, ByHand) {
  // Columns: both shadowed 3, false shadow 2, false light 1, both lit 4, background 2.
  expectCells(countSamples(row("### ##.....  "), row("### ..#....  ")), 3, 2, 1, 4, 10);
}

TEST(Counts, WeightsAreSummedPerCell) {
  const std::vector<double> weights = {0.5, 0.25, 8, 2, 1, 1024};
  expectCells(countSamples(row("##.. #"), row("#.#. #"), weights), 0.5 + 1024, 0.25, 8, 2, 5);
}

TEST(Counts, SelectionLeavesTheRestOut) {
  const std::vector<std::uint8_t> selected = {1, 0, 0, 255, 1};
  expectCells(countSamples(row("##..#"), row("#.#.#"), {}, selected), 2, 0, 0, 1, 3);
}

TEST(Counts, ColumnsAreIndependentOfTheMasksShape) {
  Mask candidate = row("##..#.");
  Mask truth = row("#.#.##");
  const Counts flat = countSamples(candidate, truth);
  candidate.width = truth.width = 2;
  candidate.height = truth.height = 3;
  EXPECT_TRUE(sameBits(flat, countSamples(candidate, truth)));
}

TEST(Counts, EmptyMasksHaveNoSamples) {
  expectCells(countSamples(Mask{}, Mask{}), 0, 0, 0, 0, 0);
  expectCells(countSamples(Mask{0, 7, {}}, Mask{0, 7, {}}), 0, 0, 0, 0, 0);
  expectCells(countSamples(row("   "), row("   ")), 0, 0, 0, 0, 0);
}

TEST(Counts, RandomMasksAgreeWithAnIndependentTally) {
  EXPECT_TRUE(rc::check([] {
    const Comparison c = arbitraryComparison();
    // One pass per cell, in extended precision and without rows.
    const auto tally = [&](Shade candidate, Shade truth) {
      long double sum = 0;
      for (std::size_t i = 0; i < c.weights.size(); ++i) {
        const bool counts = c.selected[i] != 0 && c.candidate.samples[i] == candidate &&
                            c.truth.samples[i] == truth;
        sum += counts ? static_cast<long double>(c.weights[i]) : 0;
      }
      return static_cast<double>(sum);
    };
    const Counts counts = countSamples(c.candidate, c.truth, c.weights, c.selected);
    // At most 48 + 48 roundings of half an ulp each, none of them cancelling.
    const auto near = [](double a, double b) { return std::abs(a - b) <= 96 * 1.2e-16 * b; };
    RC_ASSERT(near(counts.truePositive, tally(Shade::shadowed, Shade::shadowed)));
    RC_ASSERT(near(counts.falsePositive, tally(Shade::shadowed, Shade::lit)));
    RC_ASSERT(near(counts.falseNegative, tally(Shade::lit, Shade::shadowed)));
    RC_ASSERT(near(counts.trueNegative, tally(Shade::lit, Shade::lit)));
  }));
}

TEST(Counts, SwappingTheMasksSwapsTheErrors) {
  EXPECT_TRUE(rc::check([] {
    const Comparison c = arbitraryComparison();
    const Counts ab = countSamples(c.candidate, c.truth, c.weights, c.selected);
    Counts ba = countSamples(c.truth, c.candidate, c.weights, c.selected);
    std::swap(ba.falsePositive, ba.falseNegative);
    RC_ASSERT(sameBits(ab, ba));
  }));
}

TEST(Counts, ComplementSwapsPositiveAndNegative) {
  EXPECT_TRUE(rc::check([] {
    const Comparison c = arbitraryComparison();
    const Counts counts = countSamples(c.candidate, c.truth, c.weights, c.selected);
    Counts other =
        countSamples(complement(c.candidate), complement(c.truth), c.weights, c.selected);
    std::swap(other.truePositive, other.trueNegative);
    std::swap(other.falsePositive, other.falseNegative);
    RC_ASSERT(sameBits(counts, other));
  }));
}

TEST(Counts, AMaskAgreesWithItself) {
  EXPECT_TRUE(rc::check([] {
    const Comparison c = arbitraryComparison();
    const Counts counts = countSamples(c.truth, c.truth, c.weights);
    RC_ASSERT(counts.falsePositive == 0 && counts.falseNegative == 0);
  }));
}

TEST(Counts, ASelectionAndItsRestAddUp) {
  EXPECT_TRUE(rc::check([] {
    const Comparison c = arbitraryComparison();
    std::vector<std::uint8_t> rest;
    for (const std::uint8_t s : c.selected) rest.push_back(s == 0 ? 1 : 0);
    const Counts all = countSamples(c.candidate, c.truth);
    const Counts in = countSamples(c.candidate, c.truth, {}, c.selected);
    const Counts out = countSamples(c.candidate, c.truth, {}, rest);
    RC_ASSERT(c.selected.empty() || all.samples == in.samples + out.samples);
    RC_ASSERT(c.selected.empty() || all.total() == in.total() + out.total());
  }));
}

TEST(Counts, UnitWeightsAreTheSameAsNone) {
  EXPECT_TRUE(rc::check([] {
    const Comparison c = arbitraryComparison();
    const std::vector<double> ones(c.truth.size(), 1.0);
    RC_ASSERT(
        sameBits(countSamples(c.candidate, c.truth), countSamples(c.candidate, c.truth, ones)));
  }));
}

TEST(Counts, RefusesWeightsThatAreNoAreas) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinite, -infinite, -1e-300}) {
    const std::vector<double> weights = {1, 1, bad};
    // The last sample is background and not selected: still a fault of whoever made the weights.
    EXPECT_THROW(countSamples(row(".. "), row(".. "), weights), InputError);
    const std::vector<std::uint8_t> selected = {1, 1, 0};
    EXPECT_THROW(countSamples(row("..."), row("..."), weights, selected), InputError);
  }
  const std::vector<double> huge = {1e308, 1e308};
  EXPECT_THROW(countSamples(row("#."), row("##"), huge), InputError);
}

TEST(Counts, RefusesMasksOfDifferentSizes) {
  EXPECT_EQ(messageOf<InputError>([] { countSamples(row("..."), row("..")); }),
            "candidate mask: 3 x 1 samples, but the truth has 2 x 1");
  Mask turned = row("......");
  turned.width = 2;
  turned.height = 3;
  Mask upright = turned;
  std::swap(upright.width, upright.height);
  EXPECT_THROW(countSamples(turned, upright), InputError);
}

TEST(Counts, RefusesMasksThatAreNotWhole) {
  EXPECT_THROW(countSamples(Mask{2, 2, {}}, Mask{2, 2, {}}), InputError);
  EXPECT_THROW(countSamples(Mask{-1, -1, {Shade::lit}}, Mask{-1, -1, {Shade::lit}}), InputError);
  EXPECT_THROW(countSamples(Mask{-1, 0, {}}, Mask{-1, 0, {}}), InputError);
}

TEST(Counts, RefusesArraysOfAnotherLength) {
  const std::vector<double> weights(2, 1.0);
  const std::vector<std::uint8_t> selected(4, 1);
  EXPECT_THROW(countSamples(row("..."), row("..."), weights), InputError);
  EXPECT_THROW(countSamples(row("..."), row("..."), {}, selected), InputError);
}

TEST(Counts, RefusesASampleThatOnlyOneMaskHas) {
  EXPECT_THROW(countSamples(row(". "), row("..")), InputError);
  Mask truth{2, 2, {Shade::lit, Shade::lit, Shade::lit, Shade::none}};
  Mask candidate{2, 2, std::vector<Shade>(4, Shade::lit)};
  EXPECT_NE(messageOf<InputError>([&] { countSamples(candidate, truth); }).find("column 1, row 1"),
            std::string::npos);
  const std::vector<std::uint8_t> elsewhere = {1, 1, 1, 0};
  EXPECT_EQ(countSamples(candidate, truth, {}, elsewhere).samples, 3U);
}

TEST(Counts, RefusesAShadeThatDoesNotExist) {
  Mask mask = row("..");
  mask.samples[1] = static_cast<Shade>(7);
  EXPECT_THROW(countSamples(mask, row("..")), InputError);
  EXPECT_THROW(countSamples(mask, mask), InputError);
}

TEST(CountClasses, AreTheCountsOfEachClassAlone) {
  EXPECT_TRUE(rc::check([] {
    const auto c = test::arbitraryComparison();
    const auto classes = countClasses(c.candidate, c.truth, c.selected, 2, c.weights);
    RC_ASSERT(classes.size() == 2U);
    for (std::uint8_t k = 0; k < 2; ++k) {
      std::vector<std::uint8_t> own(c.selected.size());
      for (std::size_t i = 0; i < own.size(); ++i) own[i] = c.selected[i] == k ? 1 : 0;
      const Counts alone =
          own.empty() ? Counts{} : countSamples(c.candidate, c.truth, c.weights, own);
      RC_ASSERT(classes[k].truePositive == alone.truePositive);
      RC_ASSERT(classes[k].falsePositive == alone.falsePositive);
      RC_ASSERT(classes[k].falseNegative == alone.falseNegative);
      RC_ASSERT(classes[k].trueNegative == alone.trueNegative);
      RC_ASSERT(classes[k].samples == alone.samples);
    }
  }));
}

/// Pictures have long runs of equal samples, which are counted in words; these end anywhere.
TEST(CountClasses, OfRunsAreThoseOneByOne) {
  EXPECT_TRUE(rc::check([](unsigned seed) {
    std::mt19937 random(seed);
    const auto runs = [&](std::size_t count, unsigned values) {
      std::vector<std::uint8_t> all;
      while (all.size() < count) {
        all.insert(all.end(), random() % 30, static_cast<std::uint8_t>(random() % values));
      }
      all.resize(count);
      return all;
    };
    const std::size_t count = random() % 300;
    const auto own = runs(count, 2);
    const auto right = runs(count, 2);
    const auto absent = runs(count, 4);
    const auto classes = runs(count, 3);
    Mask candidate{static_cast<int>(count), 1, std::vector<Shade>(count)};
    Mask truth = candidate;
    std::array<std::array<std::array<double, 2>, 2>, 3> expected{};
    for (std::size_t i = 0; i < count; ++i) {
      const bool isThere = absent[i] != 0;
      candidate.samples[i] = isThere ? static_cast<Shade>(own[i]) : Shade::none;
      truth.samples[i] = isThere ? static_cast<Shade>(right[i]) : Shade::none;
      if (isThere) ++expected.at(classes[i]).at(own[i]).at(right[i]);
    }
    const auto counts = countClasses(candidate, truth, classes, 3);
    for (std::size_t k = 0; k < 3; ++k) {
      RC_ASSERT(counts[k].trueNegative == expected[k][0][0]);
      RC_ASSERT(counts[k].falseNegative == expected[k][0][1]);
      RC_ASSERT(counts[k].falsePositive == expected[k][1][0]);
      RC_ASSERT(counts[k].truePositive == expected[k][1][1]);
    }
  }));
}

TEST(AnswersAllOf, IsFalseWhereOneSampleIsLeftOut) {
  for (const std::size_t place : {0U, 7U, 8U, 99U}) {
    Mask truth{100, 1, std::vector<Shade>(100, Shade::lit)};
    Mask candidate = truth;
    candidate.samples[place] = Shade::none;
    EXPECT_FALSE(answersAllOf(truth, candidate)) << place;
    EXPECT_TRUE(answersAllOf(candidate, truth)) << place;
    truth.samples[place] = Shade::none;
    EXPECT_TRUE(answersAllOf(truth, candidate)) << place;
  }
}

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
