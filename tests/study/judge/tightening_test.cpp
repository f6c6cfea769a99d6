#include "study/judge/gates.h"

#include "support/error_messages.h"

namespace gnomon::study {
namespace {

using ::testing::HasSubstr;

/// An error rate of 0.04 and one of 0.05, the truth to 0.001.
StudyRecord record() {
  StudyRecord study;
  study.truth.uncertainty = 0.001;
  study.results = {{"a", "noon", "camera", "all", {270, 20, 20, 690, 1000}},
                   {"a", "dusk", "camera", "all", {270, 20, 30, 680, 1000}},
                   {"a", "dusk", "camera", "distant", {}}};
  return study;
}

/// Judges a gate in each step, then looks at how loose it is.
std::vector<NoticeRecord> noticesOf(const Gate& gate, std::vector<StudyRecord> steps) {
  for (StudyRecord& step : steps) step.judgements = judgeThresholds({&gate, 1}, step);
  return looseThresholds({&gate, 1}, steps);
}

std::vector<NoticeRecord> noticesFor(std::optional<double> minimum, std::optional<double> maximum,
                                     const std::string& region = "all") {
  return noticesOf({"a", "", "", region, "error_rate", minimum, maximum, Threshold{9}}, {record()});
}

TEST(Tightening, TellsOfALimitFarFromItsNearestValue) {
  const std::vector<NoticeRecord> notices = noticesFor({}, 0.09);
  ASSERT_EQ(notices.size(), 1U);
  EXPECT_EQ(notices.at(0).line, 9);
  EXPECT_THAT(
      notices.at(0).text,
      HasSubstr("error_rate of a could be tightened: at most 0.09 allowed, 0.05 the nearest"));
}

TEST(Tightening, NearMeansAQuarterOfTheLimit) {
  EXPECT_TRUE(noticesFor({}, 0.066).empty());
  EXPECT_FALSE(noticesFor({}, 0.068).empty());
}

TEST(Tightening, NearAlsoMeansFourTolerances) {
  std::vector<StudyRecord> steps = {record()};
  steps.front().truth.uncertainty = 0.01;
  const Gate gate{"a", "", "", "all", "error_rate", {}, 0.09};
  EXPECT_TRUE(noticesOf(gate, steps).empty());
}

TEST(Tightening, OfAMinimumLooksUpward) {
  EXPECT_TRUE(noticesFor(0.035, {}).empty());
  const std::vector<NoticeRecord> notices = noticesFor(0.02, {});
  ASSERT_EQ(notices.size(), 1U);
  EXPECT_THAT(notices.at(0).text, HasSubstr("at least 0.02 allowed, 0.04 the nearest"));
}

TEST(Tightening, LeavesGatesThatDoNotHoldAlone) {
  EXPECT_TRUE(noticesFor(0.001, 0.049).empty()) << "one row fails";
  EXPECT_TRUE(noticesFor({}, 0.5, "distant").empty()) << "undefined";
}

TEST(Tightening, LeavesAGateAloneWhoseMethodWasNotMeasured) {
  const Gate gate{"a", "", "", "all", "error_rate", {}, 0.09};
  StudyRecord study = record();
  study.judgements = judgeThresholds({&gate, 1}, study);
  EXPECT_EQ(looseThresholds({&gate, 1}, {&study, 1}).size(), 1U);
  study.judgements.push_back({gate, GateVerdict::undefined, {}, "the driver draws it wrong"});
  EXPECT_TRUE(looseThresholds({&gate, 1}, {&study, 1}).empty());
}

TEST(Tightening, LooksAtAllStepsOfASweep) {
  std::vector<StudyRecord> steps = {record(), record()};
  const Gate gate{"a", "", "", "all", "error_rate", {}, 0.1};
  EXPECT_EQ(noticesOf(gate, steps).size(), 1U);
  steps.back().results.at(0).counts = {270, 60, 35, 635, 1000};
  EXPECT_TRUE(noticesOf(gate, steps).empty());
}

}  // namespace
}  // namespace gnomon::study
