#include "report/ranking.h"

#include <gtest/gtest.h>

#include "report/cases.h"
#include "report/sample_record.h"

namespace gnomon {
namespace {

using test::addDifferences;
using test::countsOf;
using test::result;
using test::sampleRecord;

TEST(Ranking, BestFirstWithMeansOverAllCases) {
  StudyRecord record = sampleRecord();
  // A second view in which "best" errs more: its mean is (10 + 10 + 40) / 3 of 1000.
  record.results.push_back(result("best", "elevation 15°", "atlas", "all", countsOf(1000, 0, 40)));
  const std::vector<RankedMethod> ranked = rankMethods(record);
  ASSERT_EQ(ranked.size(), 3U);
  EXPECT_EQ(ranked[0].label, "close");
  EXPECT_EQ(ranked[1].label, "best");
  EXPECT_EQ(ranked[2].label, "rough, \"old\"");
  EXPECT_EQ(ranked[1].cases, 3U);
  EXPECT_DOUBLE_EQ(*ranked[1].errorRate.value, 0.02);
  EXPECT_DOUBLE_EQ(*ranked[1].falseShadow.value, 0.01 / 3);
  EXPECT_DOUBLE_EQ(*ranked[1].falseLight.value, 0.05 / 3);
  EXPECT_DOUBLE_EQ(*ranked[0].iou.value, 242.0 / 254);
  EXPECT_DOUBLE_EQ(*ranked[0].ber.value, (4.0 / 750 + 8.0 / 250) / 2);
}

TEST(Ranking, CloserThanTheTruthKnowsIsNotDistinguishable) {
  // Mean uncertainty (0.002 + 0.004) / 2; "best" and "close" are 0.002 apart, "rough" 0.09.
  StudyRecord record = sampleRecord();
  addDifferences(record, 1e-6);
  const std::vector<RankedMethod> ranked = rankMethods(record);
  EXPECT_EQ(ranked[0].label, "best");
  EXPECT_DOUBLE_EQ(*ranked[0].uncertainty, 0.003);
  EXPECT_EQ(ranked[0].indistinguishable, std::vector<std::string>{"close"});
  EXPECT_EQ(ranked[1].indistinguishable, std::vector<std::string>{"best"});
  EXPECT_TRUE(ranked[2].indistinguishable.empty());
}

TEST(Ranking, AnIntervalThatHoldsZeroIsNotDistinguishable) {
  StudyRecord record = sampleRecord();
  record.truth.flips.clear();
  record.truth.uncertainty = 0;
  addDifferences(record, 1e-6);
  for (const RankedMethod& method : rankMethods(record)) {
    EXPECT_TRUE(method.indistinguishable.empty());
  }
  addDifferences(record, 0.003);
  EXPECT_EQ(rankMethods(record)[0].indistinguishable, std::vector<std::string>{"close"});
  addDifferences(record, 0.1);
  EXPECT_EQ(rankMethods(record)[0].indistinguishable.size(), 2U);
}

TEST(Ranking, WithoutAMeasurementNothingIsCalledEqual) {
  StudyRecord record = sampleRecord();
  record.truth.flips.clear();
  record.truth.uncertainty = 0;
  for (const RankedMethod& method : rankMethods(record)) {
    EXPECT_FALSE(method.uncertainty);
    EXPECT_TRUE(method.indistinguishable.empty());
  }
}

TEST(Ranking, UndefinedCasesAreLeftOutAndCounted) {
  StudyRecord record = sampleRecord(1);
  record.results.push_back(result("best", "noon", "camera", "all", Counts{0, 0, 0, 100, 100}));
  const RankedMethod best = rankMethods(record)[0];
  EXPECT_EQ(best.cases, 2U);
  EXPECT_EQ(best.errorRate.cases, 2U);
  EXPECT_DOUBLE_EQ(*best.errorRate.value, 0.005);
  EXPECT_EQ(best.iou.cases, 1U);
  EXPECT_DOUBLE_EQ(*best.iou.value, 245.0 / 255);
}

TEST(Ranking, AMethodWithoutSamplesComesLast) {
  StudyRecord record = sampleRecord(1);
  record.results.insert(record.results.begin(), result("none", "l", "camera", "all", Counts{}));
  const std::vector<RankedMethod> ranked = rankMethods(record);
  EXPECT_EQ(ranked.back().label, "none");
  EXPECT_FALSE(ranked.back().errorRate.value);
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
}  // namespace gnomon
