#include "study/judge/gains.h"

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

TEST(GainDifference, HasTheIntervalOfIndependentGains) {
  const Estimate difference =
      gainDifference({5, compare::Interval{2, 9}, 0.25}, {1, compare::Interval{-3, 5}, 0.5});
  EXPECT_EQ(difference.value, 4);
  EXPECT_EQ(difference.uncertainty, 0.75);
  EXPECT_DOUBLE_EQ(difference.interval->low, 4 - 5) << "3 below the first, 4 above the second";
  EXPECT_DOUBLE_EQ(difference.interval->high, 4 + std::sqrt(32));
  EXPECT_FALSE(gainDifference({5, std::nullopt, 0}, {1, compare::Interval{0, 2}, 0}).interval);
}

TEST(Gains, CompareGainsAcrossStudies) {
  // Mean gains: 5 points here, 1 there; the uncertainties sum to 2.
  const StudyRecord here = study("here", {{0.02, 0.06}, {0.02, 0.08}}, 0.01);
  const StudyRecord there = study("there", {{0.02, 0.03}}, 0.01);
  const ClaimRecord record = judgeClaim(newIsBetter("there"), {here, there});
  EXPECT_EQ(record.verdict, Verdict::held);
  EXPECT_THAT(record.detail, HasSubstr("5.00 points here, 1.00 points in there"));
  EXPECT_EQ(judgeClaim(newIsBetter("here"), {here, there}, 1).verdict, Verdict::failed);
}

TEST(Gains, DoNotDistinguishGainsWithinBothUncertainties) {
  const StudyRecord here = study("here", {{0.02, 0.06}}, 0.02);
  const StudyRecord there = study("there", {{0.02, 0.03}}, 0.02);
  // 3 points apart, 4 uncertain.
  EXPECT_EQ(judgeClaim(newIsBetter("there"), {here, there}).verdict, Verdict::notDistinguishable);
  EXPECT_EQ(judgeClaim(newIsBetter("here"), {here, there}, 1).verdict, Verdict::notDistinguishable);
}

/// Gains of 5 and 1 points: 4 apart. Halves of 3 and 2 come to √13 = 3.6, of 3 and 3 to 4.2.
TEST(Gains, CompareGainsByTheIntervalsOfBoth) {
  StudyRecord here = study("here", {{0.02, 0.07}}, 0.001);
  StudyRecord there = study("there", {{0.02, 0.03}}, 0.001);
  measureIntervals(here, 0.03);
  measureIntervals(there, 0.02);
  const ClaimRecord sure = judgeClaim(newIsBetter("there"), {here, there});
  EXPECT_EQ(sure.verdict, Verdict::held);
  EXPECT_THAT(sure.detail, HasSubstr("95 % interval of their difference 0.39 to 7.61 points"));
  EXPECT_EQ(judgeClaim(newIsBetter("here"), {here, there}, 1).verdict, Verdict::failed);
  measureIntervals(there, 0.03);
  EXPECT_EQ(judgeClaim(newIsBetter("there"), {here, there}).verdict, Verdict::notDistinguishable);
  there.differences.back().interval.reset();
  const ClaimRecord unknown = judgeClaim(newIsBetter("there"), {here, there});
  EXPECT_EQ(unknown.verdict, Verdict::noInterval);
  EXPECT_THAT(unknown.detail, HasSubstr("their difference has no interval"));
}

TEST(Gains, CompareGainsWithThoseOfASweep) {
  // Mean gains: 5 points here; 1 and 2, on average 1.5, there.
  const StudyRecord here = study("here", {{0.02, 0.07}}, 0.01);
  const std::vector<StudyRecord> run = {here, study("there/1", {{0.02, 0.03}}, 0.01),
                                        study("there/2.5", {{0.02, 0.04}}, 0.01),
                                        study("thereabouts", {{0.02, 0.22}}, 0.01)};
  const ClaimRecord record = judgeClaim(newIsBetter("there"), run);
  EXPECT_THAT(record.detail, HasSubstr("5.00 points here, 1.50 points in there"));
}

TEST(Gains, AboutAStudyThatWasNotRunAreNotEvaluatedAndSayWhatToRun) {
  const ClaimRecord record = judgeClaim(newIsBetter("other"), {study("s", {{0.02, 0.05}}, 0.01)});
  EXPECT_EQ(record.verdict, Verdict::notEvaluated);
  EXPECT_THAT(record.detail, HasSubstr("needs the study other in the same run"));
}

TEST(Gains, AboutAStudyWithoutTheMethodsAreNotEvaluated) {
  const ClaimRecord record = judgeClaim(
      newIsBetter("other"), {study("s", {{0.02, 0.05}}, 0.01), study("other", {}, 0.01)});
  EXPECT_EQ(record.verdict, Verdict::notEvaluated);
  EXPECT_THAT(record.detail, HasSubstr("other has no results of new and old"));
}

ClaimRecord judgeGrowth(const std::vector<StudyRecord>& steps) {
  ClaimSpec claim = newIsBetter();
  claim.gainGrows = true;
  return judgeSweepClaims({claim}, sweepOf(steps)).at(0);
}

TEST(GrowingGains, GainsGrowFromTheFirstValueToTheLast) {
  // 1, 0 and 5 points; 4 more at the last than at the first, 3 uncertain.
  const std::vector<StudyRecord> steps = {study("a", {{0.02, 0.03}, {0.04, 0.05}}, 0.01),
                                          study("b", {{0.03, 0.03}}, 0.01),
                                          study("c", {{0.02, 0.06}, {0.02, 0.08}}, 0.02)};
  const ClaimRecord record = judgeGrowth(steps);
  EXPECT_EQ(record.verdict, Verdict::held);
  EXPECT_THAT(record.detail, HasSubstr("5.00 points at surface.curvature = 1, 1.00 points at 0"));
  EXPECT_EQ(judgeGrowth({steps[2], steps[1], steps[0]}).verdict, Verdict::failed);
}

TEST(GrowingGains, GainsWithinBothUncertaintiesAreNotDistinguishable) {
  const std::vector<StudyRecord> steps = {study("a", {{0.02, 0.03}}, 0.02),
                                          study("b", {{0.02, 0.06}}, 0.02)};
  EXPECT_EQ(judgeGrowth(steps).verdict, Verdict::notDistinguishable);
  EXPECT_EQ(judgeGrowth({study("a", {}, 0.01), steps[1]}).verdict, Verdict::notEvaluated);
  EXPECT_EQ(judgeGrowth({steps[1], study("a", {}, 0.01)}).verdict, Verdict::notEvaluated);
}

TEST(GrowingGains, AGainThatGrowsIsNotEvaluatedInASingleStudy) {
  ClaimSpec claim = newIsBetter();
  claim.gainGrows = true;
  EXPECT_EQ(judgeClaim(claim, {study("s", {{0.02, 0.05}}, 0.01)}).verdict, Verdict::notEvaluated);
}

}  // namespace
}  // namespace gnomon::study
