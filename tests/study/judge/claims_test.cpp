#include "study/judge/claims.h"

#include <gmock/gmock.h>

#include "study/judge/claim_studies.h"

namespace gnomon::study {
namespace {

using test::judgeClaim;
using test::measureIntervals;
using test::newIsBetter;
using test::study;
using test::sweepOf;
using ::testing::HasSubstr;

TEST(JudgeWithin, HoldsOnTheRightSideOfEveryBoundAndFailsOnTheWrongSideOfOne) {
  const auto within = [](double value, double uncertainty) {
    return judgeWithin(withoutInterval(value, uncertainty), {1, 2});
  };
  EXPECT_EQ(within(1.5, 0.25), Verdict::held);
  EXPECT_EQ(within(1.5, 0.5), Verdict::notDistinguishable);
  EXPECT_EQ(within(2.5, 0.25), Verdict::failed);
  EXPECT_EQ(within(0.5, 0.25), Verdict::failed);
  EXPECT_EQ(within(0.5, 0.75), Verdict::notDistinguishable);
  EXPECT_EQ(judgeWithin({1.5, std::nullopt, 0}, {1, 2}), Verdict::noInterval);
  EXPECT_EQ(judgeWithin({1.5, std::nullopt, 0.6}, {1, 2}), Verdict::notDistinguishable);
  EXPECT_EQ(judgeWithin({0, std::nullopt, 0, true}, {0, std::nullopt}), Verdict::equal);
}

// ---- one method against another

TEST(Claims, HoldWhereSmallerEverywhereByMoreThanTheUncertainty) {
  const ClaimRecord record =
      judgeClaim(newIsBetter(), {study("s", {{0.02, 0.05}, {0.03, 0.08}}, 0.01)});
  EXPECT_EQ(record.verdict, Verdict::held);
  EXPECT_THAT(
      record.detail,
      HasSubstr("error_rate of “new” less than that of “old”: holds for all lights together; holds "
                "under 2 of 2 lights, fails under 0; "
                "ratio 0.39 (0.38 to 0.40)"));
  EXPECT_THAT(record.detail, HasSubstr("mean difference 4.00 points"));
  EXPECT_EQ(record.methods, (std::vector<std::string>{"new", "old"}));
}

TEST(Claims, FailWhereLargerSomewhereByMoreThanTheUncertainty) {
  const ClaimRecord record =
      judgeClaim(newIsBetter(), {study("s", {{0.02, 0.08}, {0.06, 0.03}}, 0.01)});
  EXPECT_EQ(record.verdict, Verdict::failed);
  EXPECT_THAT(record.detail,
              HasSubstr("holds under 1 of 2 lights, fails under 1; ratio 1.12 (0.25 to 2.00)"));
}

TEST(Claims, AreNotDistinguishableWithinTheUncertainty) {
  EXPECT_EQ(judgeClaim(newIsBetter(), {study("s", {{0.03, 0.035}}, 0.01)}).verdict,
            Verdict::notDistinguishable)
      << "smaller, but by less than the truth's own error";
  EXPECT_EQ(judgeClaim(newIsBetter(), {study("s", {{0.035, 0.03}}, 0.01)}).verdict,
            Verdict::notDistinguishable)
      << "larger, but by less than the truth's own error";
  EXPECT_EQ(judgeClaim(newIsBetter(), {study("s", {{0.02, 0.031}, {0.03, 0.035}}, 0.01)}).verdict,
            Verdict::notDistinguishable)
      << "by 0.008 on average";
  EXPECT_EQ(judgeClaim(newIsBetter(), {study("s", {{0.03, 0.03}}, 0)}).verdict,
            Verdict::notDistinguishable)
      << "equal";
}

TEST(Claims, AreJudgedByTheUncertaintyOfTheirOwnLight) {
  StudyRecord record = study("s", {{0.02, 0.05}, {0.02, 0.05}}, 0.04);
  EXPECT_EQ(judgeClaim(newIsBetter(), {record}).verdict, Verdict::notDistinguishable);
  // The largest uncertainty stays; that of each light is less than its difference.
  for (UncertaintyRecord& flip : record.truth.flips) flip.flipRate = 0.01;
  measureIntervals(record, 1e-6);
  EXPECT_EQ(judgeClaim(newIsBetter(), {record}).verdict, Verdict::held);
  // A light without its own is judged by the largest.
  record.truth.flips.pop_back();
  measureIntervals(record, 1e-6);
  EXPECT_EQ(judgeClaim(newIsBetter(), {record}).spread->held, 1U);
}

TEST(Claims, HoldForTheMeanOfAllLightsThoughNotUnderEach) {
  // Under the second light it cannot be told; on average it is 0.0175.
  const ClaimRecord record =
      judgeClaim(newIsBetter(), {study("s", {{0.02, 0.05}, {0.03, 0.035}}, 0.01)});
  EXPECT_EQ(record.verdict, Verdict::held);
  EXPECT_EQ(record.spread->together, Verdict::held);
  EXPECT_EQ(record.spread->held, 1U);
  EXPECT_EQ(record.spread->failed, 0U);
  EXPECT_THAT(record.detail,
              HasSubstr("holds for all lights together; holds under 1 of 2 lights, fails under 0"));
  // However good on average, a light under which it fails is not passed over.
  const ClaimRecord mixed =
      judgeClaim(newIsBetter(), {study("s", {{0.02, 0.25}, {0.05, 0.035}}, 0.01)});
  EXPECT_EQ(mixed.spread->together, Verdict::held);
  EXPECT_EQ(mixed.verdict, Verdict::failed);
  EXPECT_THAT(mixed.detail,
              HasSubstr("holds for all lights together; holds under 1 of 2 lights, fails under 1"));
  // It may fail on average though under no light by itself.
  StudyRecord wide = study("s", {{0.05, 0.02}, {0.05, 0.02}}, 0.01);
  measureIntervals(wide, 0.04);
  wide.differences.back().interval = compare::Interval{0.02, 0.04};
  wide.differences.back().verdict = DifferenceVerdict::worse;
  EXPECT_EQ(judgeClaim(newIsBetter(), {wide}).spread->failed, 0U);
  EXPECT_EQ(judgeClaim(newIsBetter(), {wide}).verdict, Verdict::failed);
  // One light says all.
  EXPECT_FALSE(judgeClaim(newIsBetter(), {study("s", {{0.02, 0.05}}, 0.01)}).spread->together);
}

TEST(Claims, OfBoundsHoldForTheMeanOfAllLightsThoughNotUnderEach) {
  ClaimSpec claim{"Below 0.05", "§4", "", "", "error_rate"};
  claim.method = "new";
  claim.below = 0.05;
  StudyRecord record = study("s", {{0.02, 0.1}, {0.045, 0.1}}, 0.01);
  record.confidence.push_back(
      {"new", "camera", "all", 0.0325, compare::Interval{0.03, 0.04}, "", 81, 12});
  const ClaimRecord judged = judgeClaim(claim, {record});
  EXPECT_EQ(judged.spread->held, 1U);
  EXPECT_EQ(judged.verdict, Verdict::held);
  record.confidence.back().interval->high = 0.051;
  EXPECT_EQ(judgeClaim(claim, {record}).verdict, Verdict::notDistinguishable);
  record.confidence.back().interval.reset();
  EXPECT_EQ(judgeClaim(claim, {record}).verdict, Verdict::noInterval);
}

TEST(Claims, AreNotEvaluatedWithoutFigures) {
  EXPECT_EQ(judgeClaim(newIsBetter(), {study("s", {}, 0.01)}).verdict, Verdict::notEvaluated);
  StudyRecord empty = study("s", {{0.02, 0.05}}, 0.01);
  for (ResultRecord& result : empty.results) result.counts = {};
  const ClaimRecord record = judgeClaim(newIsBetter(), {empty});
  EXPECT_EQ(record.verdict, Verdict::notEvaluated);
  EXPECT_THAT(record.detail, HasSubstr("error_rate is not defined for “new” and “old”"));
}

TEST(Claims, SpeakOfAnyMetric) {
  ClaimSpec claim = newIsBetter();
  claim.metric = "iou";
  // The truth's shadow is 0.3; all errors are false light: iou = 1 - rate / 0.3.
  EXPECT_EQ(judgeClaim(claim, {study("s", {{0.06, 0.03}}, 0.01)}).verdict, Verdict::held);
  EXPECT_EQ(judgeClaim(claim, {study("s", {{0.03, 0.06}}, 0.01)}).verdict, Verdict::failed);
}

TEST(Claims, SpeakOfTheirRegion) {
  ClaimSpec claim = newIsBetter();
  claim.region = "cast";
  const ClaimRecord record = judgeClaim(claim, {study("s", {{0.02, 0.05}}, 0.01)});
  EXPECT_EQ(record.verdict, Verdict::failed) << "there the other order holds";
  EXPECT_THAT(
      record.detail,
      HasSubstr("than that of “old” in the region cast: holds under 0 of 1 light, fails under 1"));
}

TEST(Claims, TakeAllFlipsToLieInTheRegion) {
  // 0.01 of all samples flip; with a tenth of them in the region, that may be 0.1 of these.
  ClaimSpec claim = newIsBetter();
  claim.region = "cast";
  std::swap(claim.less, claim.than);
  StudyRecord record = study("s", {{0.02, 0.05}}, 0.01);
  EXPECT_EQ(judgeClaim(claim, {record}).verdict, Verdict::held) << "0.25 is more than 0.01";
  for (ResultRecord& result : record.results) {
    if (result.region == "cast") result.counts.samples /= 10;
  }
  EXPECT_EQ(judgeClaim(claim, {record}).verdict, Verdict::held) << "and than 0.1";
  for (UncertaintyRecord& flip : record.truth.flips) flip.flipRate = 0.03;
  EXPECT_EQ(judgeClaim(claim, {record}).verdict, Verdict::notDistinguishable) << "not than 0.3";
}

TEST(Claims, NeedAnIntervalWithoutZero) {
  StudyRecord record = study("s", {{0.02, 0.05}, {0.03, 0.08}}, 0.001);
  measureIntervals(record, 0.045);
  const ClaimRecord one = judgeClaim(newIsBetter(), {record});
  EXPECT_EQ(one.verdict, Verdict::notDistinguishable) << "0.04 on average is less than 0.045";
  EXPECT_EQ(one.spread->held, 1U);
  EXPECT_EQ(one.spread->notDistinguishable(), 1U);
  ClaimSpec reverse = newIsBetter();
  std::swap(reverse.less, reverse.than);
  EXPECT_EQ(judgeClaim(reverse, {record}).verdict, Verdict::failed) << "under the second light";
  measureIntervals(record, 0.06);
  EXPECT_EQ(judgeClaim(reverse, {record}).verdict, Verdict::notDistinguishable);
  measureIntervals(record, 0.02);
  EXPECT_EQ(judgeClaim(newIsBetter(), {record}).verdict, Verdict::held);
  record.differences.back().interval.reset();
  record.differences.back().verdict = DifferenceVerdict::noInterval;
  EXPECT_EQ(judgeClaim(newIsBetter(), {record}).verdict, Verdict::noInterval)
      << "an interval was refused";
}

/// Over the lights: one without an interval among lights under which it holds leaves all open, one
/// among lights under which it does not hold changes nothing.
TEST(Claims, AreWithoutAnIntervalOnlyForWantOfOne) {
  const auto verdictOf = [](std::vector<DifferenceVerdict> lights) {
    StudyRecord record = study("s", {{0.02, 0.05}, {0.03, 0.08}}, 0.001);
    measureIntervals(record, 0.001);
    std::erase_if(record.differences, [](const auto& row) { return row.light == "all"; });
    for (std::size_t l = 0; l < lights.size(); ++l) {
      DifferenceRecord& row = record.differences.at(l);
      row.verdict = lights[l];
      if (lights[l] == DifferenceVerdict::noInterval) row.interval.reset();
      if (lights[l] == DifferenceVerdict::notDistinguishable) {
        row.interval = compare::Interval{-0.1, 0.1};
      }
    }
    ClaimSpread spread = *judgeClaim(newIsBetter(), {record}).spread;
    EXPECT_EQ(spread.cases, 2U);
    return std::array{spread.held, spread.equal, spread.notDistinguishable(),
                      spread.withoutInterval};
  };
  using enum DifferenceVerdict;
  using Counts = std::array<std::size_t, 4>;
  EXPECT_EQ(verdictOf({worse, worse}), (Counts{2, 0, 0, 0}));
  EXPECT_EQ(verdictOf({worse, noInterval}), (Counts{1, 0, 0, 1}));
  EXPECT_EQ(verdictOf({equal, noInterval}), (Counts{0, 1, 0, 1}));
  EXPECT_EQ(verdictOf({notDistinguishable, equal}), (Counts{0, 1, 1, 0}));
}

TEST(Claims, TellHowTheyFareOverManyLights) {
  const StudyRecord record = study(
      "s", {{0.012, 0.1}, {0.024, 0.1}, {0.0312, 0.1}, {0.04, 0.1}, {0.2, 0.1}, {0.1, 0.1}}, 0.001);
  const ClaimRecord judged = judgeClaim(newIsBetter(), {record});
  EXPECT_EQ(judged.verdict, Verdict::failed);
  ASSERT_TRUE(judged.spread);
  EXPECT_EQ(judged.spread->cases, 6U);
  EXPECT_EQ(judged.spread->held, 4U);
  EXPECT_EQ(judged.spread->failed, 1U);
  EXPECT_EQ(judged.spread->notDistinguishable(), 1U);
  EXPECT_EQ(judged.spread->quantity, "ratio");
  EXPECT_TRUE(judged.spread->hasIntervals);
  const Quartiles& ratios = *judged.spread->quartiles;
  EXPECT_NEAR(ratios.least, 0.12, 1e-12);
  EXPECT_NEAR(ratios.first, 0.258, 1e-12);
  EXPECT_NEAR(ratios.median, 0.356, 1e-12);
  EXPECT_NEAR(ratios.third, 0.85, 1e-12);
  EXPECT_NEAR(ratios.most, 2, 1e-12);
  EXPECT_THAT(judged.detail, HasSubstr("holds under 4 of 6 lights, fails under 1; ratio 0.36 (0.12 "
                                       "to 2.00, quartiles 0.26 and 0.85)"));
}

TEST(Claims, HaveNoRatioToNoErrorAtAll) {
  const ClaimRecord judged = judgeClaim(newIsBetter(), {study("s", {{0.02, 0.0}}, 0.001)});
  EXPECT_EQ(judged.verdict, Verdict::failed);
  EXPECT_FALSE(judged.spread->quartiles);
  EXPECT_THAT(judged.detail, HasSubstr("fails under 1; mean difference"));
}

TEST(Claims, SayCasesWhereThereAreSeveralViews) {
  StudyRecord record = study("s", {{0.02, 0.05}}, 0.01);
  for (ResultRecord& result : study("s", {{0.02, 0.05}}, 0.01).results) {
    result.view = "atlas";
    record.results.push_back(result);
  }
  EXPECT_THAT(judgeClaim(newIsBetter(), {record}).detail,
              HasSubstr("holds in 1 of 2 cases, fails in 0"));
}

// ---- lengths

/// A study whose method `new` has given length ratios, one a light; `old` none at all.
StudyRecord lengthStudy(const std::vector<double>& ratios, std::optional<double> lengthError) {
  std::vector<std::pair<double, double>> rates(ratios.size(), {0.02, 0.05});
  StudyRecord record = study("s", rates, 0.5);
  for (UncertaintyRecord& flip : record.truth.flips) flip.lengthError = lengthError;
  std::size_t next = 0;
  for (ResultRecord& result : record.results) {
    if (result.method != "new" || result.region != "all") continue;
    const double ratio = ratios[next++];
    result.lengths = compare::ShadowLengths{100, ratio, ratio - 0.1, ratio + 0.1, 8.0};
  }
  return record;
}

ClaimSpec newIsBetween(std::optional<double> above, std::optional<double> below) {
  ClaimSpec claim{"As long as the truth's", "§4", "", "", "shadow_length_ratio"};
  claim.method = "new";
  claim.above = above;
  claim.below = below;
  return claim;
}

TEST(Claims, BetweenBoundsHoldWhereWithinEverywhere) {
  const ClaimRecord record =
      judgeClaim(newIsBetween(0.95, 1.05), {lengthStudy({1.0, 1.03, 0.97}, 0.01)});
  EXPECT_EQ(record.verdict, Verdict::held);
  EXPECT_THAT(record.detail,
              HasSubstr("shadow_length_ratio of “new” between 0.95 and 1.05: holds under "
                        "3 of 3 lights, fails under 0; value 1.00 (0.97 to 1.03); "
                        "no interval exists for it"));
}

TEST(Claims, BetweenBoundsFailWhereOutsideSomewhere) {
  const ClaimRecord above =
      judgeClaim(newIsBetween(0.95, 1.05), {lengthStudy({1.0, 1.2, 0.97}, 0.01)});
  EXPECT_EQ(above.verdict, Verdict::failed);
  EXPECT_THAT(above.detail,
              HasSubstr("holds under 2 of 3 lights, fails under 1; value 1.00 (0.97 to 1.20)"));
  EXPECT_EQ(judgeClaim(newIsBetween(0.95, 1.05), {lengthStudy({1.0, 0.8}, 0.01)}).verdict,
            Verdict::failed);
}

TEST(Claims, NearABoundAreNotDistinguishable) {
  for (const double ratio : {0.945, 0.955, 1.045, 1.055}) {
    EXPECT_EQ(judgeClaim(newIsBetween(0.95, 1.05), {lengthStudy({1.0, ratio}, 0.01)}).verdict,
              Verdict::notDistinguishable)
        << ratio;
    EXPECT_EQ(judgeClaim(newIsBetween(0.95, 1.05), {lengthStudy({1.0, ratio}, 0.0)}).verdict,
              ratio > 0.95 && ratio < 1.05 ? Verdict::held : Verdict::failed)
        << ratio << ", by an exact truth";
  }
  EXPECT_EQ(judgeClaim(newIsBetween(0.95, 1.05), {lengthStudy({1.05}, 0.0)}).verdict,
            Verdict::notDistinguishable)
      << "on the bound itself";
}

TEST(Claims, MayHaveOneBoundAlone) {
  EXPECT_EQ(judgeClaim(newIsBetween(1.05, {}), {lengthStudy({1.1, 9}, 0.01)}).verdict,
            Verdict::held);
  EXPECT_EQ(judgeClaim(newIsBetween(1.05, {}), {lengthStudy({1.1, 1}, 0.01)}).verdict,
            Verdict::failed);
  EXPECT_EQ(judgeClaim(newIsBetween({}, 1.05), {lengthStudy({1, 0}, 0.01)}).verdict, Verdict::held);
  EXPECT_THAT(judgeClaim(newIsBetween({}, 1.05), {lengthStudy({1, 2}, 0.01)}).detail,
              HasSubstr("of “new” below 1.05: holds under 1 of 2 lights, fails under 1"));
}

TEST(Claims, SayWhereTheMetricIsNotDefined) {
  StudyRecord record = lengthStudy({1.0, 1.02}, 0.01);
  record.results.front().lengths = compare::ShadowLengths{};
  const ClaimRecord judged = judgeClaim(newIsBetween(0.95, 1.05), {record});
  EXPECT_EQ(judged.verdict, Verdict::held);
  EXPECT_THAT(
      judged.detail,
      HasSubstr("holds under 1 of 1 light, fails under 0; value 1.02, not defined in 1 more"));
  ClaimSpec old = newIsBetween(0.95, 1.05);
  old.method = "old";
  EXPECT_EQ(judgeClaim(old, {record}).verdict, Verdict::notEvaluated);
  EXPECT_THAT(judgeClaim(old, {record}).detail,
              HasSubstr("shadow_length_ratio is not defined for “old”"));
}

TEST(Claims, AboutRatesBetweenBoundsGoByTheFlips) {
  ClaimSpec claim = newIsBetween({}, 0.05);
  claim.metric = "error_rate";
  EXPECT_EQ(judgeClaim(claim, {study("s", {{0.02, 0.1}}, 0.01)}).verdict, Verdict::held);
  EXPECT_EQ(judgeClaim(claim, {study("s", {{0.045, 0.1}}, 0.01)}).verdict,
            Verdict::notDistinguishable);
  EXPECT_EQ(judgeClaim(claim, {study("s", {{0.2, 0.1}}, 0.01)}).verdict, Verdict::failed);
  StudyRecord wide = study("s", {{0.02, 0.1}}, 0.01);
  measureIntervals(wide, 0.04);
  EXPECT_EQ(judgeClaim(claim, {wide}).verdict, Verdict::notDistinguishable)
      << "and by the interval";
  wide.confidence[0].interval.reset();
  EXPECT_EQ(judgeClaim(claim, {wide}).verdict, Verdict::noInterval);
  claim.region = "cast";
  EXPECT_EQ(judgeClaim(claim, {study("s", {{0.02, 0.1}}, 0.01)}).verdict, Verdict::failed);
}

TEST(Claims, OrderLengthsByTheTruthsOwnLengths) {
  StudyRecord record = lengthStudy({1.0, 1.02}, 0.01);
  for (ResultRecord& result : record.results) {
    if (result.method == "old" && result.region == "all") {
      result.lengths = compare::ShadowLengths{100, 1.1, 1.0, 1.2, 8.0};
    }
  }
  ClaimSpec claim = newIsBetter();
  claim.metric = "shadow_length_ratio";
  const ClaimRecord judged = judgeClaim(claim, {record});
  EXPECT_EQ(judged.verdict, Verdict::held) << "though half of the samples flip";
  EXPECT_THAT(judged.detail, HasSubstr("mean difference 0.090"));
  for (UncertaintyRecord& flip : record.truth.flips) flip.lengthError = 0.09;
  EXPECT_EQ(judgeClaim(claim, {record}).verdict, Verdict::notDistinguishable);
}

// ---- boundaries

/// A study whose methods `new` and `old` have given values of one boundary metric under one light,
/// where the coarser truth has the value `truths`.
StudyRecord boundaryStudy(compare::MetricId metric, double ofNew, double ofOld,
                          std::optional<double> truths) {
  StudyRecord record = study("s", {{0.02, 0.05}}, 0.5);
  record.truth.flips[0].boundaries = {{metric, truths, {}}};
  record.results[0].boundaries = {{metric, ofNew, {}}};
  record.results[1].boundaries = {{metric, ofOld, {}}};
  return record;
}

TEST(Claims, OrderBoundariesByTheTruthsOwn) {
  ClaimSpec claim = newIsBetter();
  claim.metric = "assd";
  const ClaimRecord judged = judgeClaim(claim, {boundaryStudy("assd", 0.5, 0.75, 0.125)});
  EXPECT_EQ(judged.verdict, Verdict::held) << "though half of the samples flip";
  EXPECT_THAT(judged.detail, HasSubstr("mean difference 0.250"));
  EXPECT_EQ(judgeClaim(claim, {boundaryStudy("assd", 0.5, 0.75, 0.25)}).verdict,
            Verdict::notDistinguishable);
  EXPECT_EQ(judgeClaim(claim, {boundaryStudy("assd", 0.75, 0.5, 0.125)}).verdict, Verdict::failed);

  claim.metric = "surface_dice_2";
  EXPECT_EQ(judgeClaim(claim, {boundaryStudy("surface_dice_2", 0.5, 0.75, 0.875)}).verdict,
            Verdict::held);
  EXPECT_EQ(judgeClaim(claim, {boundaryStudy("surface_dice_2", 0.5, 0.75, 0.75)}).verdict,
            Verdict::notDistinguishable);
}

TEST(Claims, TellNoBoundariesApartWithoutTheTruthsOwn) {
  ClaimSpec claim = newIsBetter();
  claim.metric = "hd95";
  StudyRecord record = boundaryStudy("hd95", 1, 100, {});
  EXPECT_EQ(judgeClaim(claim, {record}).verdict, Verdict::notDistinguishable);
  record.truth.flips.clear();
  EXPECT_EQ(judgeClaim(claim, {record}).verdict, Verdict::notDistinguishable);
  record.results[0].boundaries[0].value.reset();
  EXPECT_EQ(judgeClaim(claim, {record}).verdict, Verdict::notEvaluated);
}

TEST(Claims, AreJudgedInTheirOrder) {
  ClaimSpec reverse = newIsBetter();
  std::swap(reverse.less, reverse.than);
  const auto records = judgeClaims({newIsBetter(), reverse}, study("s", {{0.02, 0.05}}, 0.01));
  ASSERT_EQ(records.size(), 2U);
  EXPECT_EQ(records[0].verdict, Verdict::held);
  EXPECT_EQ(records[1].verdict, Verdict::failed);
}

// ---- over the values of a sweep

ClaimRecord judgeVerdicts(const std::vector<Verdict>& verdicts) {
  std::vector<StudyRecord> steps;
  for (const Verdict verdict : verdicts) {
    steps.emplace_back();
    steps.back().claims = {{"another", "", Verdict::failed, ""}, {"c", "", verdict, ""}};
  }
  return judgeSweepClaims({newIsBetter(), newIsBetter()}, sweepOf(steps)).at(1);
}

TEST(SweepClaims, OtherClaimsMustHoldAtEveryValue) {
  using V = Verdict;
  const V unsure = V::notDistinguishable;
  EXPECT_EQ(judgeVerdicts({V::held, V::held}).verdict, V::held);
  EXPECT_EQ(judgeVerdicts({V::held, unsure}).verdict, unsure);
  EXPECT_EQ(judgeVerdicts({V::notEvaluated, unsure}).verdict, unsure);
  EXPECT_EQ(judgeVerdicts({V::held, V::notEvaluated}).verdict, V::notEvaluated);
  EXPECT_EQ(judgeVerdicts({V::held, V::noInterval}).verdict, V::noInterval);
  EXPECT_EQ(judgeVerdicts({unsure, V::noInterval}).verdict, unsure)
      << "not for want of an interval";
  EXPECT_EQ(judgeVerdicts({V::equal, V::equal}).verdict, V::equal);
  EXPECT_EQ(judgeVerdicts({V::equal, V::held}).verdict, unsure);
  EXPECT_EQ(judgeVerdicts({V::noInterval, V::failed}).verdict, V::failed);
  const ClaimRecord record = judgeVerdicts({V::held, V::failed, unsure, V::held});
  EXPECT_EQ(record.verdict, V::failed);
  EXPECT_EQ(record.detail,
            "surface.curvature: held at 0, 1.5; failed at 0.5; not distinguishable at 1");
  EXPECT_EQ(record.text, newIsBetter().text);
}

}  // namespace
}  // namespace gnomon::study
