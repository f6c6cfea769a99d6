#include "study/judge/thresholds.h"

#include <limits>

#include "common/error.h"
#include "support/error_messages.h"

namespace gnomon {
namespace {

using ::testing::HasSubstr;

/// 1000 samples of which 20 are falsely shadowed and 30 falsely lit: error_rate 0.05.
constexpr Counts fivePercent{270, 20, 30, 680, 1000};
constexpr Counts nothing{};
/// All lit, and so is the truth: error_rate 0, but iou is undefined.
constexpr Counts allLit{0, 0, 0, 100, 100};

std::vector<ResultRecord> results() {
  return {{"a", "noon", "camera", "all", fivePercent},
          {"a", "noon", "camera", "distant", nothing},
          {"a", "dusk", "camera", "all", allLit},
          {"b", "noon", "camera", "all", allLit}};
}

ThresholdSpec gate(std::string metric, std::optional<double> minimum,
                   std::optional<double> maximum) {
  return {"a", "noon", "camera", "all", std::move(metric), minimum, maximum};
}

ThresholdRecord judged(const ThresholdSpec& threshold) {
  const auto records = judgeThresholds({threshold}, results());
  EXPECT_EQ(records.size(), 1U);
  return records.at(0);
}

TEST(Thresholds, HoldUpToAndIncludingTheirLimits) {
  EXPECT_TRUE(judged(gate("error_rate", {}, 0.06)).passed);
  EXPECT_TRUE(judged(gate("error_rate", {}, 0.05)).passed);
  EXPECT_FALSE(judged(gate("error_rate", {}, 0.0499)).passed);
  EXPECT_TRUE(judged(gate("error_rate", 0.05, {})).passed);
  EXPECT_FALSE(judged(gate("error_rate", 0.0501, {})).passed);
}

TEST(Thresholds, WithTwoLimitsMeetBoth) {
  EXPECT_TRUE(judged(gate("false_light", 0.03, 0.03)).passed);
  EXPECT_FALSE(judged(gate("false_light", 0.01, 0.02)).passed);
  EXPECT_FALSE(judged(gate("false_light", 0.04, 0.05)).passed);
}

TEST(Thresholds, RecordWhatWasJudged) {
  const ThresholdRecord record = judged(gate("false_shadow", {}, 0.5));
  EXPECT_EQ(record.method, "a");
  EXPECT_EQ(record.light, "noon");
  EXPECT_EQ(record.view, "camera");
  EXPECT_EQ(record.region, "all");
  EXPECT_EQ(record.metric, "false_shadow");
  EXPECT_EQ(record.value, 0.02);
  EXPECT_EQ(record.minimum, std::nullopt);
  EXPECT_EQ(record.maximum, 0.5);
}

TEST(Thresholds, FailOnAnUndefinedMetricWhateverTheLimit) {
  ThresholdSpec empty = gate("error_rate", {}, 1);
  empty.region = "distant";
  EXPECT_FALSE(judged(empty).passed);
  EXPECT_EQ(judged(empty).value, std::nullopt);
  empty.maximum = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(judged(empty).passed);
  ThresholdSpec noShadow = gate("iou", 0, {});
  noShadow.light = "dusk";
  EXPECT_FALSE(judged(noShadow).passed);
}

TEST(Thresholds, FailOnALimitThatIsNoNumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(judged(gate("error_rate", {}, nan)).passed);
  EXPECT_FALSE(judged(gate("error_rate", nan, {})).passed);
}

TEST(Thresholds, LeftFreeGateEveryRowThatMatches) {
  ThresholdSpec anyLight = gate("error_rate", {}, 0.01);
  anyLight.light.clear();
  auto records = judgeThresholds({anyLight}, results());
  ASSERT_EQ(records.size(), 2U);
  EXPECT_FALSE(records[0].passed);
  EXPECT_TRUE(records[1].passed);

  const ThresholdSpec anything{"", "", "", "", "error_rate", {}, 0.01};
  records = judgeThresholds({anything}, results());
  ASSERT_EQ(records.size(), 4U);
  EXPECT_EQ(records[3].method, "b");
}

TEST(Thresholds, ThatMatchNothingAreAFault) {
  for (const ThresholdSpec& threshold : {ThresholdSpec{"c", "", "", "all", "iou", 0.5, {}},
                                         ThresholdSpec{"b", "dusk", "", "all", "iou", 0.5, {}},
                                         ThresholdSpec{"", "", "atlas", "all", "iou", 0.5, {}}}) {
    EXPECT_THAT(messageOf<InputError>([&] { (void)judgeThresholds({threshold}, results()); }),
                HasSubstr("threshold on iou of \"" + threshold.method + "\": no result matches"));
  }
  EXPECT_THROW((void)judgeThresholds({gate("iou", 0.5, {})}, {}), InputError);
}

TEST(Thresholds, NoneGiveNoRecords) {
  EXPECT_TRUE(judgeThresholds({}, results()).empty());
}

TEST(Thresholds, OneThatFailsFailsTheStudy) {
  StudyRecord study;
  EXPECT_EQ(study.status(), RunStatus::notJudged);
  study.thresholds = judgeThresholds({gate("error_rate", {}, 0.06)}, results());
  EXPECT_EQ(study.status(), RunStatus::pass);
  study.thresholds.push_back(judged(gate("error_rate", {}, 0.04)));
  EXPECT_EQ(study.status(), RunStatus::fail);
}

}  // namespace
}  // namespace gnomon
