#include "study/judge/radius_check.h"

#include <gtest/gtest.h>

#include "common/error.h"
#include "study/spec/study_file_fixture.h"

namespace gnomon::study {
namespace {

ClaimRecord claimOf(Verdict verdict) {
  return {"a is better", "a test", verdict, ""};
}

DifferenceRecord differenceOf(DifferenceVerdict verdict) {
  DifferenceRecord difference;
  difference.view = "camera";
  difference.first = "a";
  difference.second = "b";
  difference.verdict = verdict;
  return difference;
}

StudyRecord recordOf(Verdict claim, DifferenceVerdict difference) {
  StudyRecord record;
  record.claims = {claimOf(claim)};
  record.differences = {differenceOf(difference)};
  return record;
}

TEST(RadiusCheck, KeepsTheVerdictsAtBothRadii) {
  StudyRecord record = recordOf(Verdict::held, DifferenceVerdict::better);
  keepRadiusChecks(record, recordOf(Verdict::failed, DifferenceVerdict::better),
                   recordOf(Verdict::held, DifferenceVerdict::better));
  const auto& claim = record.claims.front().radius;
  ASSERT_TRUE(claim);
  EXPECT_EQ(claim->atHalf, Verdict::failed);
  EXPECT_EQ(claim->atTwice, Verdict::held);
  EXPECT_TRUE(claim->turns(Verdict::held));
  ASSERT_TRUE(record.differences.front().radius);
  EXPECT_FALSE(record.differences.front().radius->turns(DifferenceVerdict::better));
}

TEST(RadiusCheck, RefusesRecordsOfAnotherStudy) {
  StudyRecord record = recordOf(Verdict::held, DifferenceVerdict::better);
  StudyRecord other = record;
  other.differences.front().second = "c";
  EXPECT_THROW(keepRadiusChecks(record, record, other), InternalError);
  other.differences.clear();
  EXPECT_THROW(keepRadiusChecks(record, other, record), InternalError);
}

using RadiusOfStudy = StudyFile;

TEST_F(RadiusOfStudy, VariesForTheMethodsAlone) {
  StudySpec study = readWith({"bake.radius=20", "method.1.bake.radius=8"});
  const StudySpec twice = withRadiusTimes(study, 2);
  EXPECT_EQ(twice.bake.settings.radiusTexels, 20) << "by which the truth parts its regions";
  EXPECT_EQ(twice.methods[0].bake.settings.radiusTexels, 40);
  EXPECT_EQ(twice.methods[1].bake.settings.radiusTexels, 16);
  EXPECT_TRUE(twice.thresholds.empty());
}

}  // namespace
}  // namespace gnomon::study
