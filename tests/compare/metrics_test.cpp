#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <string>

#include "common/error.h"
#include "compare/answer_metrics.h"
#include "compare/boundaries.h"
#include "compare/counts.h"
#include "compare/masks.h"
#include "compare/metric.h"
#include "masks.h"
#include "support/error_messages.h"

namespace gnomon::compare {
namespace {

using test::arbitraryComparison;
using test::Comparison;
using test::complement;
using test::row;
using ::testing::AllOf;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;

TEST(CommonPixels, KeepsWhereTheTruthHasASampleInsideTheRegion) {
  const Mask candidate = test::row("..##.#");
  const Mask truth = test::row(".# #.#");
  const Mask roi = test::row("...# #");
  const ComparedMasks masks = commonPixels(candidate, truth, &roi);
  // Black and grey of the region of interest do not count.
  EXPECT_THAT(masks.candidate.samples, ElementsAreArray(test::row("..    ").samples));
  EXPECT_THAT(masks.truth.samples, ElementsAreArray(test::row(".#    ").samples));
  EXPECT_EQ(masks.compared, 2U);
  EXPECT_EQ(masks.withoutSample, 1U);
  EXPECT_EQ(masks.outsideRoi, 3U);
}

TEST(CommonPixels, TheCandidateMayAnswerWhereItIsNotAskedButNotTheOtherWayRound) {
  const Mask truth = test::row("  .#.#");
  const ComparedMasks masks = commonPixels(test::row(".#.##."), truth, nullptr);
  EXPECT_EQ(masks.compared, 4U);
  EXPECT_EQ(masks.candidate.samples[0], Shade::none);
  EXPECT_THAT(messageOf<InputError>([&] { commonPixels(test::row(".#. #. "), truth, nullptr); }),
              HasSubstr("7 × 1 pixels found, but the truth has 6 × 1"));
  EXPECT_THAT(messageOf<InputError>([&] { commonPixels(test::row(".#. # "), truth, nullptr); }),
              AllOf(HasSubstr("no sample at 2 of the 4 pixels"), HasSubstr("column 3, row 0")));
  const Mask roi = test::row("  . .");
  EXPECT_THAT(messageOf<InputError>([&] { commonPixels(truth, truth, &roi); }),
              HasSubstr("region of interest: 5 × 1 pixels found"));
  EXPECT_THAT(messageOf<InputError>([&] {
                const Mask region = test::row("####.#");
                commonPixels(test::row(".#.#  "), test::row("......"), &region);
              }),
              HasSubstr("no sample at 1 of the 1 pixels"));
}

TEST(CommonPixels, SaysWhyNothingIsLeft) {
  const Mask truth = test::row("  .#");
  const auto message = [&](const Mask& of, const Mask* roi) {
    return messageOf<InputError>([&] { commonPixels(of, of, roi); });
  };
  const Mask empty = test::row("    ");
  EXPECT_EQ(message(empty, nullptr), "truth: no pixel has a sample");
  const Mask dark = test::row("####");
  EXPECT_EQ(message(truth, &dark), "region of interest: no pixel is white");
  EXPECT_EQ(message(truth, &empty), "region of interest: no pixel is white");
  const Mask beside = test::row("..##");
  EXPECT_EQ(message(truth, &beside), "region of interest: the truth has no sample in it");
}

TEST(MaskMetrics, AreTheRatesAndTheBoundariesByTheirNames) {
  Mask truth = test::row("..####..........");
  truth.width = truth.height = 4;
  Mask candidate = test::row("...####.........");
  candidate.width = candidate.height = 4;
  const std::vector<Metric> metrics = maskMetrics(candidate, truth);
  const std::vector<MetricId> ids = metricsOfKinds({MetricKind::rate, MetricKind::boundary});
  ASSERT_EQ(metrics.size(), ids.size());
  for (std::size_t i = 0; i < metrics.size(); ++i) EXPECT_EQ(metrics[i].id, ids[i]);
  EXPECT_EQ(metrics[0].value, 2.0 / 16);
  const std::vector<Metric> boundaries = compareBoundaries(candidate, truth);
  EXPECT_EQ(metricNamed(metrics, "assd").value, boundaries[0].value);
  EXPECT_TRUE(boundaries[0].value);
}

constexpr MetricRange rangeOfShare{};

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
  EXPECT_EQ(limitOfText("5 %", rangeOfShare), 0.05);
  EXPECT_EQ(limitOfText("0.7%", rangeOfShare), 0.007);
  EXPECT_EQ(limitOfText("12.5  %", rangeOfShare), 0.125);
  EXPECT_EQ(limitOfText("100 %", rangeOfShare), 1.0);
  EXPECT_EQ(limitOfText("0.05", rangeOfShare), 0.05);
}

TEST(LimitOfText, TakesNothingElse) {
  for (const char* text : {"", "%", " %", "five %", "5 %%", "% 5", "5 % ", "1e2 %", "nan %",
                           "inf %", "0x5 %", "5,0 %", "--5 %", "5 percent", "5‰"}) {
    EXPECT_FALSE(limitOfText(text, rangeOfShare)) << text;
  }
  EXPECT_FALSE(limitOfText("5 %", metricRange("mcc", {})));
  EXPECT_FALSE(limitOfText("5 %", metricRange("hd95", {10, 10})));
}

TEST(RequireInRange, RefusesWhatTheMetricCannotBe) {
  EXPECT_NO_THROW(requireInRange(0, "error_rate", rangeOfShare));
  EXPECT_NO_THROW(requireInRange(1, "iou", rangeOfShare));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double limit : {-0.1, 1.0000001, 20.0, 1e300, -5.0, infinite, -infinite, nan}) {
    EXPECT_THROW(requireInRange(limit, "error_rate", rangeOfShare), InputError) << limit;
  }
  EXPECT_EQ(messageOf<InputError>([] { requireInRange(20, "error_rate", rangeOfShare); }),
            "20 found, 0 to 1 expected; error_rate is a share: 0.05, or \"5 %\"");
  EXPECT_EQ(messageOf<InputError>([] { requireInRange(-2, "mcc", metricRange("mcc", {})); }),
            "-2 found, -1 to 1 expected");
}

TEST(RequireMissable, RefusesWhatNothingCanFail) {
  const auto require = [](std::optional<double> minimum, std::optional<double> maximum) {
    requireMissable(minimum, maximum, "error_rate", rangeOfShare);
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

Counts counts(double tp, double fp, double fn, double tn, std::size_t samples = 1) {
  return {tp, fp, fn, tn, samples};
}

double value(const Counts& c, MetricId id) {
  const Metric metric = rate(c, id);
  EXPECT_TRUE(metric.value) << id.name() << ": " << metric.reason;
  return metric.value.value_or(std::numeric_limits<double>::quiet_NaN());
}

/// Undefined, and for this reason.
void expectUndefined(const Counts& c, MetricId id, std::string_view reason) {
  const Metric metric = rate(c, id);
  EXPECT_FALSE(metric.value) << id.name();
  EXPECT_EQ(metric.reason, reason) << id.name();
}

Counts arbitraryCounts() {
  const Comparison c = arbitraryComparison();
  return countSamples(c.candidate, c.truth, c.weights);
}

bool near(double a, double b) {
  return std::abs(a - b) <= 1e-12;
}

TEST(Rates, ByHand) {
  const Counts c = counts(3, 2, 1, 4, 10);
  EXPECT_DOUBLE_EQ(value(c, "error_rate"), 0.3);
  EXPECT_DOUBLE_EQ(value(c, "false_shadow"), 0.2);
  EXPECT_DOUBLE_EQ(value(c, "false_light"), 0.1);
  EXPECT_DOUBLE_EQ(value(c, "fpr"), 2.0 / 6);
  EXPECT_DOUBLE_EQ(value(c, "fnr"), 1.0 / 4);
  EXPECT_DOUBLE_EQ(value(c, "ber"), 7.0 / 24);
  EXPECT_DOUBLE_EQ(value(c, "iou"), 0.5);
  EXPECT_DOUBLE_EQ(value(c, "f1"), 2.0 / 3);
  EXPECT_DOUBLE_EQ(value(c, "mcc"), 10 / std::sqrt(5.0 * 4 * 6 * 5));
  EXPECT_DOUBLE_EQ(value(c, "prevalence"), 0.4);
}

TEST(Rates, MaskToRateByHand) {
  // Six samples: one false shadow, one false light.
  const Counts c = countSamples(row("##...#"), row("#.#..#"));
  EXPECT_DOUBLE_EQ(value(c, "error_rate"), 1.0 / 3);
  EXPECT_DOUBLE_EQ(value(c, "iou"), 0.5);
  EXPECT_DOUBLE_EQ(value(c, "mcc"), 1.0 / 3);
}

TEST(Rates, PerfectAndOppositeMasksAreExact) {
  for (const double tp : {1.0, 3.0, 1e-9, 7e8}) {
    const Counts perfect = counts(tp, 0, 0, 5, 8);
    for (const MetricId zero : std::initializer_list<MetricId>{
             "error_rate", "false_shadow", "false_light", "fpr", "fnr", "ber"}) {
      EXPECT_EQ(value(perfect, zero), 0) << zero.name();
    }
    for (const MetricId one : std::initializer_list<MetricId>{"iou", "f1", "mcc"}) {
      EXPECT_EQ(value(perfect, one), 1) << one.name();
    }
    const Counts opposite = counts(0, tp, 5, 0, 8);
    EXPECT_EQ(value(opposite, "mcc"), -1);
    EXPECT_EQ(value(opposite, "iou"), 0);
    EXPECT_EQ(value(opposite, "f1"), 0);
    EXPECT_EQ(value(opposite, "ber"), 1);
  }
}

TEST(Rates, AnAnswerThatIgnoresTheTruthScoresAsChance) {
  // Independent masks: candidate shadows 30 %, truth 20 %.
  const Counts c = counts(0.06, 0.24, 0.14, 0.56, 100);
  EXPECT_NEAR(value(c, "mcc"), 0, 1e-15);
  EXPECT_NEAR(value(c, "ber"), 0.5, 1e-15);
}

TEST(Rates, IdentitiesHoldForRandomMasks) {
  EXPECT_TRUE(rc::check([] {
    const Counts c = arbitraryCounts();
    const auto get = [&](MetricId id) { return rate(c, id).value; };
    const auto error = get("error_rate");
    RC_ASSERT(error.has_value() == (c.total() > 0));
    if (!error) return;
    RC_ASSERT(near(*error, *get("false_shadow") + *get("false_light")));
    const auto iou = get("iou");
    RC_ASSERT(iou.has_value() == get("f1").has_value());
    if (iou) RC_ASSERT(near(*get("f1"), 2 * *iou / (1 + *iou)));
    RC_ASSERT(get("ber").has_value() == (get("fpr") && get("fnr")));
    if (get("ber")) RC_ASSERT(near(*get("ber"), (*get("fpr") + *get("fnr")) / 2));
    const double shadow = *get("prevalence");
    const double ofShadow = get("fnr").value_or(0) * shadow;
    RC_ASSERT(near(*error, get("fpr").value_or(0) * (1 - shadow) + ofShadow));
  }));
}

TEST(Rates, MccIsTheCorrelationOfTheTwoMasks) {
  EXPECT_TRUE(rc::check([] {
    const Comparison c = arbitraryComparison();
    const Counts counted = countSamples(c.candidate, c.truth);
    // Pearson's correlation of 0/1 variables, sample by sample.
    double n = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
    for (std::size_t i = 0; i < c.truth.size(); ++i) {
      if (c.truth.samples[i] == Shade::none) continue;
      const double a = c.candidate.samples[i] == Shade::shadowed ? 1 : 0;
      const double b = c.truth.samples[i] == Shade::shadowed ? 1 : 0;
      n += 1, x += a, y += b, xx += a * a, yy += b * b, xy += a * b;
    }
    const double spread = (n * xx - x * x) * (n * yy - y * y);
    const auto mcc = rate(counted, "mcc").value;
    RC_ASSERT(mcc.has_value() == (spread > 0));
    if (mcc) RC_ASSERT(near(*mcc, (n * xy - x * y) / std::sqrt(spread)));
  }));
}

TEST(Rates, SymmetriesHoldForRandomMasks) {
  EXPECT_TRUE(rc::check([] {
    const Comparison c = arbitraryComparison();
    const Counts ab = countSamples(c.candidate, c.truth, c.weights);
    const Counts ba = countSamples(c.truth, c.candidate, c.weights);
    const Counts inverse = countSamples(complement(c.candidate), complement(c.truth), c.weights);
    const auto same = [](std::optional<double> a, std::optional<double> b) {
      return a.has_value() == b.has_value() && (!a || near(*a, *b));
    };
    for (const MetricId name : std::initializer_list<MetricId>{"error_rate", "iou", "f1", "mcc"}) {
      RC_ASSERT(same(rate(ab, name).value, rate(ba, name).value));
    }
    RC_ASSERT(same(rate(ab, "false_shadow").value, rate(ba, "false_light").value));
    for (const MetricId name : std::initializer_list<MetricId>{"error_rate", "ber", "mcc"}) {
      RC_ASSERT(same(rate(ab, name).value, rate(inverse, name).value));
    }
    RC_ASSERT(same(rate(ab, "fpr").value, rate(inverse, "fnr").value));
  }));
}

TEST(Rates, StayInTheirRange) {
  EXPECT_TRUE(rc::check([] {
    for (const Metric& metric : rates(arbitraryCounts())) {
      RC_ASSERT(metric.value.has_value() == metric.reason.empty());
      if (!metric.value) continue;
      RC_ASSERT(*metric.value <= 1);
      RC_ASSERT(*metric.value >= (metric.id == "mcc" ? -1 : 0));
    }
  }));
}

TEST(Rates, NothingIsDefinedWithoutSamplesOrArea) {
  for (const MetricId id : metricsOfKinds({MetricKind::rate})) {
    expectUndefined(counts(0, 0, 0, 0, 0), id, "no samples");
    expectUndefined(counts(0, 0, 0, 0, 9), id, "the samples have no area");
  }
}

TEST(Rates, UndefinedCasesSayWhy) {
  const Counts noTruthShadow = counts(0, 2, 0, 3);
  expectUndefined(noTruthShadow, "fnr", "the truth has no shadow");
  expectUndefined(noTruthShadow, "ber", "the truth has no shadow");
  expectUndefined(noTruthShadow, "mcc", "the truth has no shadow");
  EXPECT_EQ(value(noTruthShadow, "iou"), 0);
  EXPECT_EQ(value(noTruthShadow, "fpr"), 0.4);

  const Counts noShadow = counts(0, 0, 0, 3);
  expectUndefined(noShadow, "iou", "neither the truth nor the candidate has a shadow");
  expectUndefined(noShadow, "f1", "neither the truth nor the candidate has a shadow");
  EXPECT_EQ(value(noShadow, "error_rate"), 0);

  const Counts noTruthLight = counts(2, 0, 3, 0);
  expectUndefined(noTruthLight, "fpr", "the truth has no lit sample");
  expectUndefined(noTruthLight, "ber", "the truth has no lit sample");
  expectUndefined(noTruthLight, "mcc", "the truth has no lit sample");
  EXPECT_EQ(value(noTruthLight, "fnr"), 0.6);

  expectUndefined(counts(0, 0, 2, 3), "mcc", "the candidate has no shadow");
  expectUndefined(counts(2, 3, 0, 0), "mcc", "the candidate has no lit sample");
}

TEST(Rates, DoNotDependOnTheUnitOfArea) {
  const Counts c = counts(3, 2, 1, 4, 10);
  for (const double unit : {1e-300, 1e-150, 1e150, 1e307}) {
    const Counts scaled = counts(3 * unit, 2 * unit, 1 * unit, 4 * unit, 10);
    for (const MetricId id : metricsOfKinds({MetricKind::rate})) {
      EXPECT_NEAR(value(scaled, id), value(c, id), 1e-14) << id.name() << " at " << unit;
    }
  }
}

TEST(Rates, RefusesCellsThatNoMaskCanHave) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinite, -1.0}) {
    EXPECT_THROW(rates(counts(1, bad, 1, 1)), InternalError);
    EXPECT_THROW(rate(counts(1, 1, 1, bad), "iou"), InternalError);
  }
}

TEST(Rates, AreThoseOfTheTable) {
  const Counts c = counts(3, 2, 1, 4, 10);
  const std::vector<MetricId> ids = metricsOfKinds({MetricKind::rate});
  const std::vector<Metric> metrics = rates(c);
  ASSERT_EQ(metrics.size(), ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    EXPECT_EQ(metrics[i].id, ids[i]);
    EXPECT_EQ(metrics[i].value, rate(c, ids[i]).value);
  }
  EXPECT_THROW(rate(c, "assd"), InternalError);
}

TEST(MetricTable, HasEveryNameOnceByKinds) {
  std::set<std::string_view> names;
  MetricKind last = MetricKind::rate;
  for (const MetricId id : allMetrics()) {
    EXPECT_TRUE(names.insert(id.name()).second) << id.name();
    EXPECT_EQ(MetricId::find(id.name()), id);
    EXPECT_GE(id.kind(), last) << "in the order of columns";
    last = id.kind();
  }
  EXPECT_EQ(MetricId::find("accuracy"), std::nullopt);
  EXPECT_THROW((void)MetricId::of("accuracy"), InternalError);
}

}  // namespace
}  // namespace gnomon::compare
