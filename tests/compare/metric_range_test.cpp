#include "compare/metric_range.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

#include "common/error.h"
#include "compare/mask_metrics.h"
#include "masks.h"
#include "support/error_messages.h"

namespace gnomon::compare {
namespace {

constexpr MetricRange share{};

/// Half of the samples shadowed, drawn one by one: the same for the same seed.
Mask randomMask(int side, unsigned seed) {
  std::mt19937 random(seed);
  Mask mask{side, side, {}};
  for (int i = 0; i < side * side; ++i) {
    mask.samples.push_back(random() % 2 == 0 ? Shade::lit : Shade::shadowed);
  }
  return mask;
}

TEST(MetricRange, HoldsEveryValueOfRandomMasks) {
  constexpr int side = 12;
  const PictureExtent picture{std::hypot(side, side), side * side};
  int values = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    for (const Metric& metric :
         maskMetrics(randomMask(side, seed), randomMask(side, seed + 1000))) {
      if (!metric.value) continue;
      const MetricRange range = metricRange(metric.id, picture);
      EXPECT_GE(*metric.value, range.least) << metric.name();
      EXPECT_LE(*metric.value, range.most) << metric.name();
      ++values;
    }
  }
  EXPECT_GT(values, 300 * 10);
}

/// So that no limit is taken that no mask could miss.
TEST(MetricRange, EndsAreReachedByTheRightAndTheWrongMask) {
  const Mask truth = test::row("#.");
  for (const MetricId metric :
       std::initializer_list<MetricId>{"error_rate", "fpr", "fnr", "ber", "iou", "f1", "mcc"}) {
    const double right = *rate(countSamples(truth, truth), metric).value;
    const double wrong = *rate(countSamples(test::complement(truth), truth), metric).value;
    const MetricRange range = metricRange(metric, {2, 2});
    EXPECT_EQ(std::min(right, wrong), range.least) << metric.name();
    EXPECT_EQ(std::max(right, wrong), range.most) << metric.name();
  }
}

TEST(MetricRange, OfDistancesAndLengthsIsThePictures) {
  const PictureExtent picture{100, 4800};
  for (const MetricId metric : std::initializer_list<MetricId>{"assd", "hd95"}) {
    EXPECT_EQ(metricRange(metric, picture).most, 100);
    EXPECT_FALSE(metricRange(metric, picture).isShare);
  }
  EXPECT_EQ(metricRange("shadow_length_ratio", picture).most, 25);
  EXPECT_EQ(metricRange("shadow_runs", picture).most, 4800);
  EXPECT_TRUE(metricRange("surface_dice_2", picture).isShare);
  EXPECT_FALSE(metricRange("mcc", picture).isShare);
}

TEST(LimitOfText, TakesAPercentageOfAShareToTheSameDouble) {
  EXPECT_EQ(limitOfText("5 %", share), 0.05);
  EXPECT_EQ(limitOfText("0.7%", share), 0.007);
  EXPECT_EQ(limitOfText("12.5  %", share), 0.125);
  EXPECT_EQ(limitOfText("100 %", share), 1.0);
  EXPECT_EQ(limitOfText("0.05", share), 0.05);
}

TEST(LimitOfText, TakesNothingElse) {
  for (const char* text : {"", "%", " %", "five %", "5 %%", "% 5", "5 % ", "1e2 %", "nan %",
                           "inf %", "0x5 %", "5,0 %", "--5 %", "5 percent", "5‰"}) {
    EXPECT_FALSE(limitOfText(text, share)) << text;
  }
  EXPECT_FALSE(limitOfText("5 %", metricRange("mcc", {})));
  EXPECT_FALSE(limitOfText("5 %", metricRange("hd95", {10, 10})));
}

TEST(RequireInRange, RefusesWhatTheMetricCannotBe) {
  EXPECT_NO_THROW(requireInRange(0, "error_rate", share));
  EXPECT_NO_THROW(requireInRange(1, "iou", share));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double limit : {-0.1, 1.0000001, 20.0, 1e300, -5.0, infinite, -infinite, nan}) {
    EXPECT_THROW(requireInRange(limit, "error_rate", share), InputError) << limit;
  }
  EXPECT_EQ(messageOf<InputError>([] { requireInRange(20, "error_rate", share); }),
            "20 found, 0 to 1 expected; error_rate is a share: 0.05, or \"5 %\"");
  EXPECT_EQ(messageOf<InputError>([] { requireInRange(-2, "mcc", metricRange("mcc", {})); }),
            "-2 found, -1 to 1 expected");
}

TEST(RequireMissable, RefusesWhatNothingCanFail) {
  const auto require = [](std::optional<double> minimum, std::optional<double> maximum) {
    requireMissable(minimum, maximum, "error_rate", share);
  };
  EXPECT_NO_THROW(require({}, 0));
  EXPECT_NO_THROW(require({}, 0.999));
  EXPECT_NO_THROW(require(0.001, {}));
  EXPECT_NO_THROW(require(1, {}));
  EXPECT_NO_THROW(require(0, 0.5)) << "the maximum can fail";
  EXPECT_NO_THROW(require(0.5, 1)) << "the minimum can fail";
  EXPECT_THROW(require({}, 1), InputError);
  EXPECT_THROW(require(0, {}), InputError);
  EXPECT_THROW(require(-0.0, {}), InputError);
  EXPECT_THROW(require(0, 1), InputError);
  EXPECT_THROW(require(0.6, 0.5), InputError) << "nothing can hold it";
  EXPECT_EQ(messageOf<InputError>([&] { require({}, 1); }),
            "1 found, which no error_rate can miss: below 1 expected; error_rate is a share: 0.05, "
            "or \"5 %\"");
}

TEST(IsOfTruthAlone, HoldsForWhatNoCandidateChanges) {
  const Mask truth = randomMask(9, 7);
  const std::vector<Metric> first = rates(countSamples(randomMask(9, 1), truth));
  const std::vector<Metric> second = rates(countSamples(test::complement(truth), truth));
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].value == second[i].value, isOfTruthAlone(first[i].id)) << first[i].name();
  }
  EXPECT_TRUE(isOfTruthAlone("shadow_runs"));
}

TEST(IsSettled, HoldsWhereTheTruthIsAllLitOrAllShadowed) {
  const auto settled = [](bool (*isSettled)(MetricId)) {
    std::vector<std::string_view> names;
    for (const MetricId id : metricsOfKinds({MetricKind::rate, MetricKind::boundary})) {
      if (isSettled(id)) names.push_back(id.name());
    }
    return names;
  };
  using ::testing::ElementsAre;
  EXPECT_THAT(settled(isSettledByLight), ElementsAre("false_light", "iou", "f1", "prevalence"));
  EXPECT_THAT(settled(isSettledByShadow), ElementsAre("false_shadow", "prevalence"));
  EXPECT_FALSE(isSettledByLight("shadow_length_ratio"));
}

}  // namespace
}  // namespace gnomon::compare
