#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "compare/confidence_interval.h"
#include "compare/random_errors.h"

/// How often the 95 % interval holds the rate that the masks were made with, and how its width
/// compares with how much the rates of such masks vary.

namespace gnomon::compare {
namespace {

using test::errorMask;
using test::ErrorShape;
using test::mixed;
using test::RandomFields;

constexpr int drawnSide = 144;
constexpr int maskCount = 400;

Mask litEverywhere() {
  return {drawnSide, drawnSide, std::vector<Shade>(std::size_t{drawnSide} * drawnSide, Shade::lit)};
}

/// Intervals of many masks that were made alike.
class Coverage {
 public:
  /// @param found   the mask's own rate, or difference of rates
  /// @param expected  that of all masks on average
  void add(const ConfidenceInterval& confidence, double found, double expected) {
    rates_.push_back(found);
    if (!confidence.interval) return;
    ++intervals_;
    if (confidence.interval->holds(expected)) ++held_;
    halfWidths_ += confidence.interval->high - found;  // never cut: rates are small
  }
  void add(const Coverage& other) {
    intervals_ += other.intervals_;
    held_ += other.held_;
  }
  [[nodiscard]] double share() const { return held_ / intervals_; }
  [[nodiscard]] double intervals() const { return intervals_; }
  /// The mean half-width over 1.96 standard deviations of the masks' rates.
  [[nodiscard]] double relativeWidth() const {
    const auto count = static_cast<double>(rates_.size());
    const double mean = std::accumulate(rates_.begin(), rates_.end(), 0.0) / count;
    double squares = 0;
    for (const double rate : rates_) squares += (rate - mean) * (rate - mean);
    return halfWidths_ / intervals_ / (1.96 * std::sqrt(squares / (count - 1)));
  }

 private:
  double intervals_ = 0;
  double held_ = 0;
  double halfWidths_ = 0;
  std::vector<double> rates_;
};

/// What a case alone must keep. 400 masks tell a share of 95 % to ± 2 %.
void expectSound(const Coverage& coverage, const std::string& which) {
  EXPECT_GE(coverage.share(), 0.915) << which;
  EXPECT_LE(coverage.share(), 0.985) << which;
  EXPECT_GE(coverage.relativeWidth(), 1 / 1.5) << which;
  EXPECT_LE(coverage.relativeWidth(), 1.5) << which;
}

/// The errors of the first lights together.
BlockErrors together(const std::vector<BlockErrors>& lights, std::size_t count) {
  BlockErrors sum = lights.front();
  for (std::size_t l = 1; l < count; ++l) sum += lights[l];
  return sum;
}

void addRate(Coverage& coverage, const BlockErrors& cells, const Tiling& tiling, double expected) {
  coverage.add(rateConfidence(cells, tiling), cells.rate(), expected);
}

class CoverageOfRates : public testing::TestWithParam<double> {};

/// Rates of 1, 5 and 20 %, blobs and contours, 1, 3 and 5 lights whose errors are alike: their
/// fields have 60 % in common.
TEST_P(CoverageOfRates, IsThatOfTheMasks) {
  const Mask truth = litEverywhere();
  const Tiling tiling = chooseTiling(truth);
  RandomFields fields(drawnSide, GetParam(), 11);
  constexpr std::array<double, 3> rates = {0.01, 0.05, 0.2};
  constexpr std::array<std::size_t, 3> lightCounts = {1, 3, 5};
  std::array<Coverage, 18> cases;
  for (int m = 0; m < maskCount; ++m) {
    const std::vector<float> common = fields.next();
    std::vector<std::vector<float>> ofLights;
    for (int l = 0; l < 5; ++l) ofLights.push_back(mixed(common, fields.next(), 0.6));
    std::size_t which = 0;
    for (const ErrorShape shape : {ErrorShape::blobs, ErrorShape::contours}) {
      for (const double rate : rates) {
        std::vector<BlockErrors> cells;
        for (const auto& field : ofLights) {
          const Mask mask = errorMask(field, drawnSide, shape, rate);
          cells.push_back(blockErrors(mask, truth, tiling.cellSide));
        }
        for (const std::size_t lights : lightCounts) {
          addRate(cases[which++], together(cells, lights), tiling, rate);
        }
      }
    }
  }
  Coverage all;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    all.add(cases[i]);
    // Large blobs of a rate of 1 % are missing from most masks.
    if (cases[i].intervals() < 0.9 * maskCount) continue;
    expectSound(cases[i], fmt::format("{}, rate {}, {} lights", i < 9 ? "blobs" : "contours",
                                      rates[i / 3 % 3], lightCounts[i % 3]));
  }
  EXPECT_GE(all.share(), 0.93);
  EXPECT_LE(all.share(), 0.97);
}

INSTANTIATE_TEST_SUITE_P(FeaturesUpToASixteenthOfTheSide, CoverageOfRates,
                         testing::Values(1.0, 1.8, 2.6));

/// Two methods whose errors are alike, and alike under three lights.
TEST(CoverageOfDifferences, IsThatOfTheMasks) {
  const Mask truth = litEverywhere();
  const Tiling tiling = chooseTiling(truth);
  RandomFields fields(drawnSide, 2, 12);
  struct Rates {
    double first, second;
  };
  constexpr std::array<Rates, 4> pairs = {{{0.05, 0.05}, {0.05, 0.03}, {0.2, 0.05}, {0.02, 0.01}}};
  std::array<Coverage, 4> cases;
  for (int m = 0; m < maskCount; ++m) {
    const std::vector<float> common = fields.next();
    std::array<std::vector<BlockErrors>, 4> first;
    std::array<std::vector<BlockErrors>, 4> second;
    for (int l = 0; l < 3; ++l) {
      const std::vector<float> ofLight = mixed(common, fields.next(), 0.6);
      const std::vector<float> a = mixed(ofLight, fields.next(), 0.8);
      const std::vector<float> b = mixed(ofLight, fields.next(), 0.8);
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        const auto cellsOf = [&](const std::vector<float>& field, double rate) {
          return blockErrors(errorMask(field, drawnSide, ErrorShape::blobs, rate), truth,
                             tiling.cellSide);
        };
        first[i].push_back(cellsOf(a, pairs[i].first));
        second[i].push_back(cellsOf(b, pairs[i].second));
      }
    }
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const BlockErrors a = together(first[i], 3);
      const BlockErrors b = together(second[i], 3);
      cases[i].add(differenceConfidence(a, b, tiling), a.rate() - b.rate(),
                   pairs[i].first - pairs[i].second);
    }
  }
  Coverage all;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_GT(cases[i].intervals(), 0.99 * maskCount);
    expectSound(cases[i], "pair " + std::to_string(i));
    all.add(cases[i]);
  }
  EXPECT_GE(all.share(), 0.93);
  EXPECT_LE(all.share(), 0.97);
}

// ---- the verdict on two methods

/// Errors of two methods that have 80 % of their fields in common, and as often under all lights.
struct Pair {
  const char* name;
  double scale;  ///< of the blobs
  double (*rate)(double place);
  std::size_t lights;
  int leastFound;  ///< of 120 where the second method has half the error of the first
};

constexpr int pairsDrawn = 120;

/// Among them errors so few, or in so narrow a strip at the terminator, that hardly any pair has
/// blocks enough for Student's t.
constexpr std::array<Pair, 8> pairKinds = {
    {{"everywhere", 1, [](double) { return 0.05; }, 1, 115},
     {"rare", 2, [](double) { return 0.005; }, 1, 25},
     {"very rare", 2, [](double) { return 0.001; }, 1, 0},
     {"single", 1, [](double) { return 0.0002; }, 1, 0},
     {"under three lights", 2, [](double) { return 0.01; }, 3, 60},
     {"toward a terminator", 1.5, [](double x) { return 0.4 * std::exp((x - 1) / 0.1); }, 1, 110},
     {"near a terminator", 1.5, [](double x) { return 0.4 * std::exp((x - 1) / 0.03); }, 1, 90},
     {"at a terminator", 1.5, [](double x) { return 0.4 * std::exp((x - 1) / 0.01); }, 1, 45}}};

struct Found {
  int better = 0, worse = 0, withoutInterval = 0;
};

/// @param share  of the second method's rate in the first's
Found verdicts(const Pair& kind, double share) {
  const Mask truth = litEverywhere();
  const Tiling tiling = chooseTiling(truth);
  RandomFields fields(drawnSide, kind.scale, 15);
  std::vector<double> first;
  for (int x = 0; x < drawnSide; ++x) first.push_back(kind.rate((x + 0.5) / drawnSide));
  std::vector<double> second = first;
  for (double& rate : second) rate *= share;
  Found found;
  for (int m = 0; m < pairsDrawn; ++m) {
    std::vector<BlockErrors> a, b;
    for (std::size_t l = 0; l < kind.lights; ++l) {
      const std::vector<float> common = fields.next();
      const auto cellsOf = [&](const std::vector<double>& rates) {
        const Mask mask =
            errorMask(mixed(common, fields.next(), 0.8), drawnSide, ErrorShape::blobs, rates);
        return blockErrors(mask, truth, tiling.cellSide);
      };
      a.push_back(cellsOf(first));
      b.push_back(cellsOf(second));
    }
    const BlockErrors one = together(a, kind.lights);
    const BlockErrors other = together(b, kind.lights);
    const auto interval = differenceConfidence(one, other, tiling).interval;
    if (!interval) {
      // Nothing to tell: as many wrong in every block.
      EXPECT_EQ(one.wrong, other.wrong);
      ++found.withoutInterval;
    } else if (!interval->holds(0)) {
      ++(one.rate() < other.rate() ? found.better : found.worse);
    }
  }
  return found;
}

class VerdictOnPairs : public testing::TestWithParam<Pair> {};

/// 95 of 100 intervals of equal methods hold 0: of 120 pairs 6 do not, and by chance up to 11.
TEST_P(VerdictOnPairs, TellsEqualMethodsSeldomApart) {
  const Found equal = verdicts(GetParam(), 1);
  EXPECT_LE(equal.better + equal.worse, 11);
}

/// Over all kinds it is no more than 6 of 120.
TEST(VerdictOnAllPairs, TellsEqualMethodsApartInAtMostSixOf120) {
  int apart = 0;
  for (const Pair& kind : pairKinds) {
    const Found equal = verdicts(kind, 1);
    apart += equal.better + equal.worse;
  }
  EXPECT_LE(apart, 6 * static_cast<int>(pairKinds.size()));
}

TEST_P(VerdictOnPairs, FindsHalfTheError) {
  const Found half = verdicts(GetParam(), 0.5);
  EXPECT_GE(half.worse, GetParam().leastFound);
  EXPECT_LE(half.better, 1);
  EXPECT_LE(half.withoutInterval, 12);
}

INSTANTIATE_TEST_SUITE_P(OfErrors, VerdictOnPairs, testing::ValuesIn(pairKinds));

/// An object before a background, seen in an atlas's weights of one to four.
TEST(CoverageOfRates, IsThatOfTheMasksBehindASilhouetteAndUnderWeights) {
  Mask truth = litEverywhere();
  std::vector<double> weights(truth.size());
  for (int y = 0; y < drawnSide; ++y) {
    for (int x = 0; x < drawnSide; ++x) {
      const auto i = static_cast<std::size_t>(y) * drawnSide + static_cast<std::size_t>(x);
      if (std::hypot(x - 66.0, y - 79.0) > 60) truth.samples[i] = Shade::none;
      weights[i] = 1 + 3.0 * x / drawnSide;
    }
  }
  const Tiling tiling = chooseTiling(truth, weights);
  RandomFields fields(drawnSide, 1.5, 13);
  Coverage coverage;
  for (int m = 0; m < 3 * maskCount; ++m) {
    Mask mask = errorMask(fields.next(), drawnSide, ErrorShape::blobs, 0.05);
    for (std::size_t i = 0; i < mask.size(); ++i) {
      if (truth.samples[i] == Shade::none) mask.samples[i] = Shade::none;
    }
    addRate(coverage, blockErrors(mask, truth, tiling.cellSide, weights), tiling, 0.05);
  }
  expectSound(coverage, "silhouette");
}

/// How often errors are found at a place from 0 to 1 across the view.
struct Drift {
  const char* name;
  double (*rate)(double place);
};

constexpr std::array<Drift, 2> drifts = {
    {{"steady, twenty-fold over the view", [](double x) { return 0.005 + 0.1 * x; }},
     {"toward a terminator, by e each tenth of the view",
      [](double x) { return 0.02 + 0.3 * std::exp((x - 1) / 0.1); }}}};

class CoverageUnderDrift : public testing::TestWithParam<Drift> {};

/// The drift is the same in every draw: it must not count as spread.
TEST_P(CoverageUnderDrift, IsThatOfTheMasks) {
  const Mask truth = litEverywhere();
  const Tiling tiling = chooseTiling(truth);
  for (const double scale : {1.0, 2.0}) {
    for (const ErrorShape shape : {ErrorShape::blobs, ErrorShape::contours}) {
      RandomFields fields(drawnSide, scale, 14);
      std::vector<double> rates;
      for (int x = 0; x < drawnSide; ++x) {
        rates.push_back(GetParam().rate((x + 0.5) / drawnSide));
      }
      const double mean = std::accumulate(rates.begin(), rates.end(), 0.0) / drawnSide;
      Coverage coverage;
      for (int m = 0; m < maskCount; ++m) {
        const Mask mask = errorMask(fields.next(), drawnSide, shape, rates);
        addRate(coverage, blockErrors(mask, truth, tiling.cellSide), tiling, mean);
      }
      expectSound(coverage, fmt::format("{}, {}, scale {}", GetParam().name,
                                        shape == ErrorShape::blobs ? "blobs" : "contours", scale));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OfTheErrors, CoverageUnderDrift, testing::ValuesIn(drifts));

}  // namespace
}  // namespace gnomon::compare
