#include "study/claims.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gnomon {
namespace {

using ::testing::HasSubstr;

/// 10,000 samples, 30 % shadow in the truth, with a given error rate, all of it false light.
Counts withErrorRate(double rate) {
  constexpr double samples = 10'000;
  const double wrong = rate * samples;
  return {0.3 * samples - wrong, 0, wrong, 0.7 * samples, static_cast<std::size_t>(samples)};
}

/// A study whose methods `new` and `old` have given error rates, one pair a light.
StudyRecord study(const std::string& name, const std::vector<std::pair<double, double>>& rates,
                  double uncertainty) {
  StudyRecord record;
  record.name = name;
  record.truth.uncertainty = uncertainty;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    const std::string light = "light " + std::to_string(i);
    record.truth.flips.push_back({"camera", light, uncertainty});
    record.results.push_back({"new", light, "camera", "all", withErrorRate(rates[i].first)});
    record.results.push_back({"old", light, "camera", "all", withErrorRate(rates[i].second)});
    // Regions must not be judged: here the other order holds.
    record.results.push_back({"new", light, "camera", "cast", withErrorRate(0.25)});
    record.results.push_back({"old", light, "camera", "cast", withErrorRate(0.0)});
  }
  return record;
}

ClaimSpec newIsBetter(const std::string& gainExceeds = {}) {
  return {"The new method is better", "§4", "new", "old", "error_rate", gainExceeds};
}

ClaimRecord judge(const ClaimSpec& claim, const std::vector<StudyRecord>& run,
                  std::size_t own = 0) {
  const auto records = judgeClaims({claim}, run, own);
  EXPECT_EQ(records.size(), 1U);
  EXPECT_EQ(records.at(0).text, claim.text);
  EXPECT_EQ(records.at(0).source, claim.source);
  return records.at(0);
}

// ---- one method against another

TEST(Claims, HoldWhereSmallerEverywhereByMoreThanTheUncertainty) {
  const ClaimRecord record = judge(newIsBetter(), {study("s", {{0.02, 0.05}, {0.03, 0.08}}, 0.01)});
  EXPECT_EQ(record.verdict, Verdict::held);
  EXPECT_THAT(record.detail, HasSubstr("in 2 of 2 comparisons, larger in 0"));
  EXPECT_THAT(record.detail, HasSubstr("mean difference 4.00 points"));
}

TEST(Claims, FailWhereLargerSomewhereByMoreThanTheUncertainty) {
  const ClaimRecord record = judge(newIsBetter(), {study("s", {{0.02, 0.08}, {0.06, 0.03}}, 0.01)});
  EXPECT_EQ(record.verdict, Verdict::failed);
  EXPECT_THAT(record.detail, HasSubstr("in 1 of 2 comparisons, larger in 1"));
}

TEST(Claims, AreNotDistinguishableWithinTheUncertainty) {
  EXPECT_EQ(judge(newIsBetter(), {study("s", {{0.02, 0.05}, {0.03, 0.035}}, 0.01)}).verdict,
            Verdict::notDistinguishable)
      << "smaller, but by less than the truth's own error";
  EXPECT_EQ(judge(newIsBetter(), {study("s", {{0.02, 0.05}, {0.035, 0.03}}, 0.01)}).verdict,
            Verdict::notDistinguishable)
      << "larger, but by less than the truth's own error";
  EXPECT_EQ(judge(newIsBetter(), {study("s", {{0.03, 0.03}}, 0)}).verdict,
            Verdict::notDistinguishable)
      << "equal";
}

TEST(Claims, AreJudgedByTheUncertaintyOfTheirOwnLight) {
  StudyRecord record = study("s", {{0.02, 0.05}, {0.02, 0.05}}, 0.04);
  EXPECT_EQ(judge(newIsBetter(), {record}).verdict, Verdict::notDistinguishable);
  // The largest uncertainty stays; that of each light is less than its difference.
  for (UncertaintyRecord& flip : record.truth.flips) flip.flipRate = 0.01;
  EXPECT_EQ(judge(newIsBetter(), {record}).verdict, Verdict::held);
  // A light without its own is judged by the largest.
  record.truth.flips.pop_back();
  EXPECT_EQ(judge(newIsBetter(), {record}).verdict, Verdict::notDistinguishable);
}

TEST(Claims, AreNotEvaluatedWithoutFigures) {
  EXPECT_EQ(judge(newIsBetter(), {study("s", {}, 0.01)}).verdict, Verdict::notEvaluated);
  StudyRecord empty = study("s", {{0.02, 0.05}}, 0.01);
  for (ResultRecord& result : empty.results) result.counts = {};
  const ClaimRecord record = judge(newIsBetter(), {empty});
  EXPECT_EQ(record.verdict, Verdict::notEvaluated);
  EXPECT_THAT(record.detail, HasSubstr("error_rate is not defined for new and old"));
}

TEST(Claims, SpeakOfAnyMetric) {
  ClaimSpec claim = newIsBetter();
  claim.metric = "iou";
  // The truth's shadow is 0.3; all errors are false light: iou = 1 - rate / 0.3.
  EXPECT_EQ(judge(claim, {study("s", {{0.06, 0.03}}, 0.01)}).verdict, Verdict::held);
  EXPECT_EQ(judge(claim, {study("s", {{0.03, 0.06}}, 0.01)}).verdict, Verdict::failed);
}

// ---- across studies

TEST(Claims, CompareGainsAcrossStudies) {
  // Mean gains: 5 points here, 1 there; the uncertainties sum to 2.
  const StudyRecord here = study("here", {{0.02, 0.06}, {0.02, 0.08}}, 0.01);
  const StudyRecord there = study("there", {{0.02, 0.03}}, 0.01);
  const ClaimRecord record = judge(newIsBetter("there"), {here, there});
  EXPECT_EQ(record.verdict, Verdict::held);
  EXPECT_THAT(record.detail, HasSubstr("5.00 points here, 1.00 in there"));
  EXPECT_EQ(judge(newIsBetter("here"), {here, there}, 1).verdict, Verdict::failed);
}

TEST(Claims, DoNotDistinguishGainsWithinBothUncertainties) {
  const StudyRecord here = study("here", {{0.02, 0.06}}, 0.02);
  const StudyRecord there = study("there", {{0.02, 0.03}}, 0.02);
  // 3 points apart, 4 uncertain.
  EXPECT_EQ(judge(newIsBetter("there"), {here, there}).verdict, Verdict::notDistinguishable);
  EXPECT_EQ(judge(newIsBetter("here"), {here, there}, 1).verdict, Verdict::notDistinguishable);
}

TEST(Claims, AboutAStudyThatWasNotRunAreNotEvaluatedAndSayWhatToRun) {
  const ClaimRecord record = judge(newIsBetter("other"), {study("s", {{0.02, 0.05}}, 0.01)});
  EXPECT_EQ(record.verdict, Verdict::notEvaluated);
  EXPECT_THAT(record.detail, HasSubstr("needs the study other in the same run"));
}

TEST(Claims, AboutAStudyWithoutTheMethodsAreNotEvaluated) {
  const ClaimRecord record =
      judge(newIsBetter("other"), {study("s", {{0.02, 0.05}}, 0.01), study("other", {}, 0.01)});
  EXPECT_EQ(record.verdict, Verdict::notEvaluated);
  EXPECT_THAT(record.detail, HasSubstr("other has no results of new and old"));
}

TEST(Claims, AreJudgedInTheirOrder) {
  ClaimSpec reverse = newIsBetter();
  std::swap(reverse.less, reverse.than);
  const std::vector<StudyRecord> run = {study("s", {{0.02, 0.05}}, 0.01)};
  const auto records = judgeClaims({newIsBetter(), reverse}, run, 0);
  ASSERT_EQ(records.size(), 2U);
  EXPECT_EQ(records[0].verdict, Verdict::held);
  EXPECT_EQ(records[1].verdict, Verdict::failed);
}

// ---- over the values of a sweep

SweepRecord sweepOf(const std::vector<StudyRecord>& steps) {
  SweepRecord sweep;
  sweep.key = "surface.curvature";
  for (std::size_t i = 0; i < steps.size(); ++i) {
    sweep.values.push_back(0.5 * static_cast<double>(i));
  }
  sweep.steps = steps;
  return sweep;
}

ClaimRecord judgeGrowth(const std::vector<StudyRecord>& steps) {
  ClaimSpec claim = newIsBetter();
  claim.gainGrows = true;
  return judgeSweepClaims({claim}, sweepOf(steps)).at(0);
}

TEST(SweepClaims, GainsGrowFromTheFirstValueToTheLast) {
  // 1, 0 and 5 points; 4 more at the last than at the first, 3 uncertain.
  const std::vector<StudyRecord> steps = {study("a", {{0.02, 0.03}, {0.04, 0.05}}, 0.01),
                                          study("b", {{0.03, 0.03}}, 0.01),
                                          study("c", {{0.02, 0.06}, {0.02, 0.08}}, 0.02)};
  const ClaimRecord record = judgeGrowth(steps);
  EXPECT_EQ(record.verdict, Verdict::held);
  EXPECT_THAT(record.detail, HasSubstr("5.00 points at surface.curvature = 1, 1.00 at 0"));
  EXPECT_EQ(judgeGrowth({steps[2], steps[1], steps[0]}).verdict, Verdict::failed);
}

TEST(SweepClaims, GainsWithinBothUncertaintiesAreNotDistinguishable) {
  const std::vector<StudyRecord> steps = {study("a", {{0.02, 0.03}}, 0.02),
                                          study("b", {{0.02, 0.06}}, 0.02)};
  EXPECT_EQ(judgeGrowth(steps).verdict, Verdict::notDistinguishable);
  EXPECT_EQ(judgeGrowth({study("a", {}, 0.01), steps[1]}).verdict, Verdict::notEvaluated);
  EXPECT_EQ(judgeGrowth({steps[1], study("a", {}, 0.01)}).verdict, Verdict::notEvaluated);
}

TEST(SweepClaims, AGainThatGrowsIsNotEvaluatedInASingleStudy) {
  ClaimSpec claim = newIsBetter();
  claim.gainGrows = true;
  EXPECT_EQ(judge(claim, {study("s", {{0.02, 0.05}}, 0.01)}).verdict, Verdict::notEvaluated);
}

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
  const ClaimRecord record = judgeVerdicts({V::held, V::failed, unsure, V::held});
  EXPECT_EQ(record.verdict, V::failed);
  EXPECT_EQ(record.detail,
            "surface.curvature: held at 0, 1.5; failed at 0.5; not distinguishable at 1");
  EXPECT_EQ(record.text, newIsBetter().text);
}

}  // namespace
}  // namespace gnomon
