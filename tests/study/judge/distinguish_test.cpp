#include "study/judge/distinguish.h"

#include <gtest/gtest.h>

namespace gnomon::study {
namespace {

TEST(Distinguish, NeedsAnIntervalWithoutZeroAndMoreThanTheTruthsError) {
  EXPECT_EQ(distinguish({-0.02, compare::Interval{-0.03, -0.01}, 0.01}), DifferenceVerdict::better);
  EXPECT_EQ(distinguish({0.02, compare::Interval{0.01, 0.03}, 0.01}), DifferenceVerdict::worse);
  EXPECT_EQ(distinguish({0.02, compare::Interval{-0.01, 0.03}, 0}),
            DifferenceVerdict::notDistinguishable);
  EXPECT_EQ(distinguish({0.02, compare::Interval{0, 0.03}, 0}),
            DifferenceVerdict::notDistinguishable);
  EXPECT_EQ(distinguish({0.02, compare::Interval{0.01, 0.03}, 0.02}),
            DifferenceVerdict::notDistinguishable);
  EXPECT_EQ(distinguish({-0.02, compare::Interval{-0.03, -0.01}, 0.02}),
            DifferenceVerdict::notDistinguishable);
}

/// Want of an interval is an answer of its own, unless the truth's uncertainty decides without one.
TEST(Distinguish, WithoutAnIntervalSaysSo) {
  EXPECT_EQ(distinguish({0.5, std::nullopt, 0.1}), DifferenceVerdict::noInterval);
  EXPECT_EQ(distinguish({-0.5, std::nullopt, 0}), DifferenceVerdict::noInterval);
  EXPECT_EQ(distinguish({0.1, std::nullopt, 0.1}), DifferenceVerdict::notDistinguishable);
  EXPECT_EQ(opposite(DifferenceVerdict::noInterval), DifferenceVerdict::noInterval);
  EXPECT_FALSE(isDistinguishable(DifferenceVerdict::noInterval));
}

TEST(Distinguish, CallsEqualAnswersEqual) {
  EXPECT_EQ(distinguish({0, std::nullopt, 0.1, true}), DifferenceVerdict::equal);
  EXPECT_EQ(distinguish({0, std::nullopt, 0, true}, 0.5), DifferenceVerdict::noInterval)
      << "of another number than 0 equal answers say nothing";
  EXPECT_EQ(opposite(DifferenceVerdict::equal), DifferenceVerdict::equal);
  EXPECT_FALSE(isDistinguishable(DifferenceVerdict::equal));
}

TEST(LikeMethods, SortsByTheVerdict) {
  LikeMethods like;
  like.add("a", DifferenceVerdict::equal);
  like.add("b", DifferenceVerdict::notDistinguishable);
  like.add("c", DifferenceVerdict::noInterval);
  like.add("d", DifferenceVerdict::better);
  like.add("e", DifferenceVerdict::worse);
  EXPECT_EQ(like.equal, std::vector<std::string>{"a"});
  EXPECT_EQ(like.close, std::vector<std::string>{"b"});
  EXPECT_EQ(like.withoutInterval, std::vector<std::string>{"c"});
}

TEST(Distinguish, WithoutIntervalsAsksForMoreThanTheTruthsErrorAlone) {
  EXPECT_EQ(distinguish(withoutInterval(-0.02, 0.01)), DifferenceVerdict::better);
  EXPECT_EQ(distinguish(withoutInterval(0.02, 0.01)), DifferenceVerdict::worse);
  EXPECT_EQ(distinguish(withoutInterval(0.01, 0.01)), DifferenceVerdict::notDistinguishable);
  EXPECT_EQ(distinguish(withoutInterval(0, 0)), DifferenceVerdict::notDistinguishable);
}

/// Compared with a number as its distance from it is with 0.
TEST(Distinguish, OnlyTheDistanceFromTheNumberCounts) {
  for (const double number : {-0.5, 0.25, 1.0}) {
    for (const double distance : {-0.0625, 0.0625}) {
      for (const double half : {0.03125, 0.125}) {
        const compare::Interval around{distance - half, distance + half};
        const compare::Interval moved{number + distance - half, number + distance + half};
        const DifferenceVerdict verdict = distinguish({distance, around, 0.03125});
        EXPECT_EQ(distinguish({number + distance, moved, 0.03125}, number), verdict);
        EXPECT_EQ(isDistinguishable({distance, around, 0.03125}), half < 0.0625);
      }
    }
  }
}

DifferenceRecord row(const std::string& view, const std::string& light, double difference,
                     std::optional<compare::Interval> interval, double uncertainty) {
  return {view,
          light,
          "a",
          "b",
          difference,
          interval,
          interval ? "" : "too few",
          uncertainty,
          distinguish({difference, interval, uncertainty})};
}

/// Two views under two lights.
StudyRecord twoViews() {
  StudyRecord record;
  for (const char* view : {"atlas", "camera"}) {
    for (const char* light : {"all", "noon", "dusk"}) {
      record.confidence.push_back(
          {"a", view, light, 0.1, compare::Interval{0.08, 0.12}, "", 81, 12});
    }
  }
  record.differences = {row("atlas", "all", 0.03, compare::Interval{0.02, 0.04}, 0.001),
                        row("atlas", "noon", 0.05, compare::Interval{0.03, 0.07}, 0.001),
                        row("atlas", "dusk", 0.01, compare::Interval{-0.01, 0.03}, 0.001),
                        row("camera", "all", 0.01, compare::Interval{-0.03, 0.05}, 0.003)};
  return record;
}

TEST(DifferenceOf, TurnsADifferenceAsAsked) {
  const StudyRecord record = twoViews();
  EXPECT_EQ(differenceOf(record, "atlas", "noon", "a", "b")->difference, 0.05);
  const auto turned = differenceOf(record, "atlas", "noon", "b", "a");
  ASSERT_TRUE(turned);
  EXPECT_EQ(turned->first, "b");
  EXPECT_EQ(turned->difference, -0.05);
  EXPECT_EQ(turned->interval->low, -0.07);
  EXPECT_EQ(turned->interval->high, -0.03);
  EXPECT_EQ(turned->verdict, DifferenceVerdict::better);
  EXPECT_FALSE(differenceOf(record, "camera", "noon", "a", "b")) << "measured for all alone";
  EXPECT_FALSE(differenceOf(record, "atlas", "noon", "a", "c"));
}

TEST(DifferenceOf, TakesTheOnlyLightOfAStudyForAllOfThem) {
  StudyRecord record = twoViews();
  std::erase_if(record.confidence, [](const auto& c) { return c.light != "all"; });
  EXPECT_EQ(differenceOf(record, "atlas", "noon", "a", "b")->difference, 0.03);
  EXPECT_EQ(findConfidence(record, "atlas", "noon", "a")->light, "all");
  EXPECT_EQ(findConfidence(twoViews(), "atlas", "noon", "a")->light, "noon");
  EXPECT_FALSE(findConfidence(twoViews(), "atlas", "noon", "b"));
}

TEST(DifferenceOverViews, IsTheMeanWithTheMeanOfTheEnds) {
  StudyRecord record = twoViews();
  const auto mean = differenceOverViews(record, "a", "b");
  ASSERT_TRUE(mean);
  EXPECT_DOUBLE_EQ(mean->difference, 0.02);
  EXPECT_NEAR(mean->interval->low, -0.005, 1e-15);
  EXPECT_NEAR(mean->interval->high, 0.045, 1e-15);
  EXPECT_DOUBLE_EQ(mean->uncertainty, 0.002);
  EXPECT_EQ(mean->verdict, DifferenceVerdict::notDistinguishable);
  EXPECT_DOUBLE_EQ(differenceOverViews(record, "b", "a")->difference, -0.02);
  record.differences[3] = row("camera", "all", 0.01, compare::Interval{-0.01, 0.03}, 0.003);
  EXPECT_EQ(differenceOverViews(record, "a", "b")->verdict, DifferenceVerdict::worse);
  EXPECT_EQ(differenceOverViews(record, "b", "a")->verdict, DifferenceVerdict::better);
  record.differences[3] = row("camera", "all", 0.5, std::nullopt, 0.003);
  EXPECT_FALSE(differenceOverViews(record, "a", "b")->interval);
  EXPECT_EQ(differenceOverViews(record, "a", "b")->reason, "too few");
  EXPECT_EQ(differenceOverViews(record, "a", "b")->verdict, DifferenceVerdict::noInterval);
  EXPECT_FALSE(differenceOverViews(record, "a", "c"));
}

/// What has no interval in one of twelve scenes may be anything there, from -1 to 1: a difference
/// of 12 points is more than the twelfth that this can be.
TEST(MeanDifference, OneOfManyWithoutAnIntervalLeavesALargeDifferenceKnown) {
  std::vector<DifferenceRecord> scenes(
      12, row("camera", "all", 0.12, compare::Interval{0.1, 0.14}, 0.001));
  scenes[4] = row("camera", "all", 0.12, std::nullopt, 0.001);
  const DifferenceRecord large = meanDifference(scenes);
  EXPECT_EQ(large.verdict, DifferenceVerdict::worse);
  ASSERT_TRUE(large.interval);
  EXPECT_NEAR(large.interval->low, (11 * 0.1 - 1) / 12, 1e-15);
  EXPECT_NEAR(large.interval->high, (11 * 0.14 + 1) / 12, 1e-15);
  EXPECT_EQ(large.reason, "");
  for (DifferenceRecord& scene : scenes) {
    scene.difference /= 10;
    if (scene.interval) scene.interval = compare::Interval{0.01, 0.014};
  }
  const DifferenceRecord small = meanDifference(scenes);
  EXPECT_EQ(small.verdict, DifferenceVerdict::noInterval);
  EXPECT_FALSE(small.interval);
  EXPECT_EQ(small.reason, "too few");
}

TEST(MeanDifference, IsEqualWhereAllAre) {
  DifferenceRecord equal = row("camera", "all", 0, std::nullopt, 0.001);
  equal.verdict = DifferenceVerdict::equal;
  EXPECT_EQ(meanDifference({equal, equal}).verdict, DifferenceVerdict::equal);
  EXPECT_EQ(swapped(meanDifference({equal, equal})).verdict, DifferenceVerdict::equal);
  // Nothing less than half of the other's.
  const DifferenceRecord half =
      meanDifference({equal, row("camera", "all", 0.04, compare::Interval{0.03, 0.05}, 0.001)});
  EXPECT_EQ(half.verdict, DifferenceVerdict::worse);
  EXPECT_DOUBLE_EQ(half.interval->low, 0.015);
  EXPECT_EQ(half.reason, "");
}

TEST(DifferencesOverViews, HasEveryPairThatSharesAView) {
  StudyRecord record = twoViews();
  DifferenceRecord other = row("camera", "all", 0.2, compare::Interval{0.1, 0.3}, 0.003);
  other.second = "c";
  record.differences.push_back(other);
  const auto means = differencesOverViews(record, {"c", "b", "a"});
  ASSERT_EQ(means.size(), 2U) << "b and c share no view";
  EXPECT_EQ(means[0].first, "c");
  EXPECT_EQ(means[0].second, "a");
  EXPECT_EQ(means[0].difference, -0.2);
  EXPECT_EQ(means[1].first, "b");
  EXPECT_EQ(means[1].second, "a");
  EXPECT_DOUBLE_EQ(means[1].difference, -0.02);
  EXPECT_EQ(differencesOverViews(record, {"a", "b"}).size(), 1U);
}

TEST(DifferencesIn, AreThoseOfAViewAndALight) {
  const StudyRecord record = twoViews();
  ASSERT_EQ(differencesIn(record, "atlas", "dusk").size(), 1U);
  EXPECT_EQ(differencesIn(record, "atlas", "dusk")[0].difference, 0.01);
  EXPECT_TRUE(differencesIn(record, "camera", "dusk").empty());
}

}  // namespace
}  // namespace gnomon::study
