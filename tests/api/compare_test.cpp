#include "gnomon/compare.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "api/failure_of.h"

namespace gnomon::test {
namespace {

using ::testing::HasSubstr;

using Samples = std::vector<std::uint8_t>;

// Of six samples the truth has an answer at five.
const Samples right = {1, 1, 0, 0, 0, 2};
const Samples judged = {1, 0, 0, 0, 1, 2};

TEST(ApiCompare, CountsAndRates) {
  const MaskFigures figures = compareMasks({3, 2, judged}, {3, 2, right});
  EXPECT_EQ(figures.samples, 5U);
  EXPECT_EQ(figures.truePositive, 2);
  EXPECT_EQ(figures.falsePositive, 1);
  EXPECT_EQ(figures.falseNegative, 1);
  EXPECT_EQ(figures.trueNegative, 1);
  EXPECT_DOUBLE_EQ(figures.value("error_rate").value(), 2.0 / 5);
  EXPECT_DOUBLE_EQ(figures.value("iou").value(), 2.0 / 4);
}

TEST(ApiCompare, WeighsSamples) {
  const std::vector<double> weights = {1, 2, 3, 4, 5, 100};
  const MaskFigures figures =
      compareMasks({3, 2, judged}, {3, 2, right}, {.weights = weights, .region = {}});
  EXPECT_DOUBLE_EQ(figures.value("false_shadow").value(), 2.0 / 15);
  EXPECT_DOUBLE_EQ(figures.value("false_light").value(), 5.0 / 15);
}

TEST(ApiCompare, LeavesOutWhatIsOutsideTheRegion) {
  const Samples region = {1, 0, 7, 0, 0, 0};
  const MaskFigures figures =
      compareMasks({3, 2, judged}, {3, 2, right}, {.weights = {}, .region = region});
  EXPECT_EQ(figures.samples, 2U);
  EXPECT_EQ(figures.value("error_rate"), 0);
}

TEST(ApiCompare, HasAnIntervalOrAReason) {
  // Errors that lie here and there: a sixteenth of 64 × 64 samples.
  constexpr int side = 64;
  Samples truth(side * side), mine(side * side);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    truth[i] = i / 8 % 2;
    mine[i] = (i * 2654435761U >> 7U) % 16 == 0 ? 1 - truth[i] : truth[i];
  }
  const MaskFigures figures = compareMasks({side, side, mine}, {side, side, truth});
  const double error = figures.value("error_rate").value();
  ASSERT_TRUE(figures.errorInterval) << figures.intervalReason;
  EXPECT_LT(figures.errorInterval->at(0), error);
  EXPECT_GT(figures.errorInterval->at(1), error);
  EXPECT_LT(figures.errorInterval->at(1) - figures.errorInterval->at(0), error);
  const MaskFigures few = compareMasks({3, 2, judged}, {3, 2, right});
  EXPECT_FALSE(few.errorInterval);
  EXPECT_NE(few.intervalReason, "");
}

TEST(ApiCompare, AsksWhetherAMaskIsInvertedThatIsWrongNearlyEverywhere) {
  // 4 of 1000 samples of the complement are wrong.
  Samples truth(1000), inverted(1000);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    truth[i] = i % 3 == 0 ? 0 : 1;
    inverted[i] = i < 4 ? truth[i] : 1 - truth[i];
  }
  const auto noticeOf = [&](const Samples& mine) {
    return compareMasks({100, 10, mine}, {100, 10, truth}).notice;
  };
  EXPECT_EQ(noticeOf(inverted),
            "99.6 % of the samples are wrong, and the complement would be 0.4 % wrong: is one of "
            "them inverted?");
  for (std::size_t i = 0; i < 50; ++i) inverted[i] = truth[i];
  EXPECT_THAT(noticeOf(inverted), HasSubstr("95 % of the samples are wrong"));
  inverted[50] = truth[50];
  EXPECT_EQ(noticeOf(inverted), "");
  // Of shares it is |1 - V - V_truth|, which is not 1 - |V - V_truth|.
  EXPECT_EQ(
      compareShares({2, 2, std::vector<float>(4, 0.98F)}, {2, 2, std::vector<float>(4, 0.01F)})
          .notice,
      "97 % of the samples are wrong, and the complement would be 1 % wrong: is one of them "
      "inverted?");
}

constexpr float noShare = std::numeric_limits<float>::quiet_NaN();

TEST(ApiCompare, DividesSharesAmongTheCells) {
  const std::vector<float> truth = {1, 0.5F, 0, noShare};
  const std::vector<float> mine = {0.75F, 1, 0, noShare};
  const std::vector<double> weights = {2, 1, 1, 100};
  const MaskFigures figures =
      compareShares({2, 2, mine}, {2, 2, truth}, {.weights = weights, .region = {}});
  EXPECT_EQ(figures.samples, 3U);
  EXPECT_DOUBLE_EQ(figures.falsePositive, 2 * 0.25);
  EXPECT_DOUBLE_EQ(figures.falseNegative, 0.5);
  EXPECT_DOUBLE_EQ(figures.truePositive, 1);
  EXPECT_DOUBLE_EQ(figures.trueNegative, 2 * 0.75 + 0.5);
  EXPECT_DOUBLE_EQ(figures.value("mae").value(), 1.0 / 4);
  EXPECT_DOUBLE_EQ(figures.value("error_rate").value(), 1.0 / 4);
  EXPECT_DOUBLE_EQ(figures.value("rmse").value(), std::sqrt((2 * 0.0625 + 0.25) / 4));
  EXPECT_DOUBLE_EQ(figures.value("umbra_iou").value(), 1);
}

TEST(ApiCompare, FindsSharesOfZeroAndOneAsItFindsMasks) {
  const auto sharesOf = [](const Samples& mask) {
    ShareMap map{3, 2, {}};
    for (const std::uint8_t sample : mask) {
      map.shares.push_back(sample == 2 ? noShare : static_cast<float>(sample));
    }
    return map;
  };
  const MaskFigures soft = compareShares(sharesOf(judged), sharesOf(right));
  const MaskFigures hard = compareMasks({3, 2, judged}, {3, 2, right});
  for (const MaskMetric& metric : hard.metrics) {
    EXPECT_EQ(soft.value(metric.name), metric.value) << metric.name;
  }
  EXPECT_EQ(soft.value("mae"), hard.value("error_rate"));
  EXPECT_EQ(soft.errorInterval, hard.errorInterval);
}

TEST(ApiCompare, RefusesWhatIsNoShare) {
  const std::vector<float> truth = {1, 0.5F, 0, noShare};
  const auto refusal = [&](const std::vector<float>& mine, int width = 2) {
    return failureOf([&] { (void)compareShares({width, 2, mine}, {2, 2, truth}); });
  };
  EXPECT_THAT(refusal({1, 1.5F, 0, noShare}), HasSubstr("1.5 at column 1, row 0"));
  EXPECT_THAT(refusal({1, 1, -0.5F, noShare}), HasSubstr("-0.5 at column 0, row 1"));
  EXPECT_THAT(refusal({1, noShare, 0, 0}), HasSubstr("no sample at 1"));
  EXPECT_THAT(refusal({1, 1, 0, 1}, 1), HasSubstr("4 samples found, 1 × 2 expected"));
}

TEST(ApiCompare, SaysWhyAMetricIsUndefined) {
  const Samples lit(4, 1);
  const MaskFigures figures = compareMasks({2, 2, lit}, {2, 2, lit});
  EXPECT_FALSE(figures.value("iou"));
  for (const MaskMetric& metric : figures.metrics) {
    EXPECT_NE(metric.value.has_value(), !metric.reason.empty()) << metric.name;
  }
}

TEST(ApiCompare, RefusesWhatIsNoMask) {
  const Samples bad = {0, 1, 3, 0, 0, 0};
  const auto refusal = [](const MaskMap& mask, const CompareOptions& options = {}) {
    return failureOf([&] { (void)compareMasks(mask, {3, 2, right}, options); });
  };
  EXPECT_THAT(refusal({3, 2, bad}), HasSubstr("candidate: 3 found at index 2"));
  EXPECT_THAT(refusal({2, 2, judged}), HasSubstr("6 samples found, 2 × 2 expected"));
  EXPECT_THAT(refusal({2, 3, judged}), HasSubstr("2 × 3 pixels found"));
  EXPECT_THAT(refusal({3, 2, Samples(6, 2)}), HasSubstr("no sample at 5"));
  const std::vector<double> weights = {1, -1, 1, 1, 1, 1};
  EXPECT_NE(refusal({3, 2, judged}, {.weights = weights, .region = {}}), "");
  EXPECT_NE(refusal({3, 2, judged}, {.weights = {}, .region = Samples(5, 1)}), "");
  EXPECT_NE(refusal({3, 2, judged}, {.weights = {}, .region = Samples(6, 0)}), "");
  EXPECT_THAT(failureOf([] { (void)MaskFigures{}.value("rightness"); }), HasSubstr("rightness"));
}

}  // namespace
}  // namespace gnomon::test
