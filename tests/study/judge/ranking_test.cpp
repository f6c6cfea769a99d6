#include "study/judge/ranking.h"

#include <gtest/gtest.h>

#include "report/sample_record.h"
#include "study/record/cases.h"

namespace gnomon::study {
namespace {

using test::addDifferences;
using test::countsOf;
using test::result;
using test::sampleRecord;

TEST(Ranking, BestFirstWithMeansOverAllCases) {
  StudyRecord record = sampleRecord();
  // A second view in which "best" errs more: its mean is (10 + 10 + 40) / 3 of 1000.
  record.results.push_back(result("best", "elevation 15°", "atlas", "all", countsOf(1000, 0, 40)));
  record.results.push_back(result("close", "elevation 15°", "atlas", "all", countsOf(1000, 4, 8)));
  record.results.push_back(
      result("rough, \"old\"", "elevation 15°", "atlas", "all", countsOf(1000, 80, 20)));
  const std::vector<RankedMethod> ranked = rankMethods(record);
  ASSERT_EQ(ranked.size(), 3U);
  EXPECT_EQ(ranked[0].label, "close");
  EXPECT_EQ(ranked[1].label, "best");
  EXPECT_EQ(ranked[2].label, "rough, \"old\"");
  EXPECT_EQ(ranked[1].cases, 3U);
  EXPECT_DOUBLE_EQ(*ranked[1].means.errorRate, 0.02);
  EXPECT_DOUBLE_EQ(*ranked[1].means.falseShadow, 0.01 / 3);
  EXPECT_DOUBLE_EQ(*ranked[1].means.falseLight, 0.05 / 3);
  EXPECT_DOUBLE_EQ(*ranked[0].iou.value, 242.0 / 254);
  EXPECT_DOUBLE_EQ(*ranked[0].ber.value, (4.0 / 750 + 8.0 / 250) / 2);
}

/// "easy" is never wrong, but answers only where the others are at their best: under one light of
/// two. Over that light "best" has 10 of 1000 wrong, over both 25.
StudyRecord recordWithAnEasyCase() {
  StudyRecord record = sampleRecord();
  record.results.push_back(result("easy", "elevation 15°", "camera", "all", countsOf(1000, 0, 1)));
  for (ResultRecord& row : record.results) {
    if (row.method == "best" && row.light == "elevation 30°" && row.region == "all") {
      row.counts = countsOf(1000, 0, 40);
    }
  }
  return record;
}

TEST(Ranking, AMethodThatAnswersInFewerCasesHasNoRankHoweverSmallItsError) {
  const std::vector<RankedMethod> ranked = rankMethods(recordWithAnEasyCase());
  ASSERT_EQ(ranked.size(), 4U);
  EXPECT_EQ(ranked[0].label, "close");
  EXPECT_EQ(ranked[0].rank, 1U);
  EXPECT_DOUBLE_EQ(*ranked[0].means.errorRate, 0.012);
  EXPECT_FALSE(ranked[0].leaderError);
  EXPECT_EQ(ranked[1].label, "best");
  EXPECT_EQ(ranked[2].rank, 3U);
  EXPECT_EQ(ranked[3].label, "easy");
  EXPECT_FALSE(ranked[3].rank);
  EXPECT_EQ(ranked[3].cases, 1U);
  EXPECT_EQ(ranked[3].allCases, 2U);
  EXPECT_DOUBLE_EQ(*ranked[3].means.errorRate, 0.001);
  EXPECT_DOUBLE_EQ(*ranked[3].leaderError, 0.012);
}

TEST(Ranking, WithoutAMethodInEveryCaseNoneIsFirst) {
  StudyRecord record = sampleRecord();
  std::erase_if(record.results, [](const ResultRecord& row) {
    return (row.method == "best") == (row.light == "elevation 15°");
  });
  for (const RankedMethod& method : rankMethods(record)) {
    EXPECT_FALSE(method.rank) << method.label;
    EXPECT_FALSE(method.leaderError) << method.label;
  }
}

TEST(Ranking, CloserThanTheTruthKnowsIsNotDistinguishable) {
  // Mean uncertainty (0.002 + 0.004) / 2; "best" and "close" are 0.002 apart, "rough" 0.09.
  StudyRecord record = sampleRecord();
  addDifferences(record, 1e-6);
  const std::vector<RankedMethod> ranked = rankMethods(record);
  EXPECT_EQ(ranked[0].label, "best");
  EXPECT_DOUBLE_EQ(*ranked[0].uncertainty, 0.003);
  EXPECT_EQ(ranked[0].like.close, std::vector<std::string>{"close"});
  EXPECT_EQ(ranked[1].like.close, std::vector<std::string>{"best"});
  EXPECT_TRUE(ranked[2].like.close.empty());
}

TEST(Ranking, AnIntervalThatHoldsZeroIsNotDistinguishable) {
  StudyRecord record = sampleRecord();
  record.truth.flips.clear();
  record.truth.uncertainty = 0;
  addDifferences(record, 1e-6);
  for (const RankedMethod& method : rankMethods(record)) {
    EXPECT_TRUE(method.like.close.empty());
  }
  addDifferences(record, 0.003);
  EXPECT_EQ(rankMethods(record)[0].like.close, std::vector<std::string>{"close"});
  addDifferences(record, 0.1);
  EXPECT_EQ(rankMethods(record)[0].like.close.size(), 2U);
}

TEST(Ranking, WithoutAMeasurementNothingIsCalledEqual) {
  StudyRecord record = sampleRecord();
  record.truth.flips.clear();
  record.truth.uncertainty = 0;
  for (const RankedMethod& method : rankMethods(record)) {
    EXPECT_FALSE(method.uncertainty);
    EXPECT_TRUE(method.like.close.empty());
  }
}

TEST(Ranking, UndefinedCasesAreLeftOutAndCounted) {
  StudyRecord record = sampleRecord(1);
  record.results.push_back(
      result("best", "noon", "camera", "all", compare::Counts{0, 0, 0, 100, 100}));
  const RankedMethod best = rankMethods(record)[0];
  EXPECT_EQ(best.cases, 2U);
  EXPECT_EQ(best.means.cases(), 2U);
  EXPECT_DOUBLE_EQ(*best.means.errorRate, 0.005);
  EXPECT_EQ(best.iou.cases, 1U);
  EXPECT_DOUBLE_EQ(*best.iou.value, 245.0 / 255);
}

TEST(Ranking, AMethodWithoutSamplesComesLast) {
  StudyRecord record = sampleRecord(1);
  record.results.insert(record.results.begin(),
                        result("none", "l", "camera", "all", compare::Counts{}));
  const std::vector<RankedMethod> ranked = rankMethods(record);
  EXPECT_EQ(ranked.back().label, "none");
  EXPECT_FALSE(ranked.back().means.errorRate);
  EXPECT_TRUE(rankMethods(StudyRecord{}).empty());
}

TEST(Cases, UncertaintyFallsBackToTheLargest) {
  const StudyRecord record = sampleRecord();
  EXPECT_EQ(uncertaintyOf(record, {"camera", "elevation 15°"}), 0.002);
  EXPECT_EQ(uncertaintyOf(record, {"atlas", "elevation 15°"}), 0.004);
  EXPECT_EQ(uncertaintyOf(StudyRecord{}, {"atlas", "noon"}), std::nullopt);
}

TEST(Cases, AnUncertaintyOfZeroIsAMeasurement) {
  StudyRecord record = sampleRecord(1);
  record.truth.flips[0].flipRate = 0;
  EXPECT_EQ(uncertaintyOf(record, {"camera", "elevation 15°"}), 0.0);
}

}  // namespace
}  // namespace gnomon::study
