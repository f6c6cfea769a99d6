#include "study/judge/gates.h"

#include <limits>

#include "common/error.h"
#include "support/error_messages.h"

namespace gnomon::study {
namespace {

using ::testing::HasSubstr;

/// 1000 samples of which 20 are falsely shadowed and 30 falsely lit: error_rate 0.05.
constexpr compare::Counts fivePercent{270, 20, 30, 680, 1000};
constexpr compare::Counts nothing{};
/// All lit, and so is the truth: error_rate 0, but iou is undefined.
constexpr compare::Counts allLit{0, 0, 0, 100, 100};

StudyRecord judgedStudy() {
  StudyRecord study;
  study.name = "study";
  study.results = {{"a", "noon", "camera", "all", fivePercent},
                   {"a", "noon", "camera", "distant", nothing},
                   {"a", "dusk", "camera", "all", allLit},
                   {"b", "noon", "camera", "all", allLit}};
  return study;
}

Gate gate(compare::MetricId metric, std::optional<double> minimum, std::optional<double> maximum) {
  return {"a", "noon", "camera", "all", metric, minimum, maximum};
}

Judgement judged(const Gate& threshold) {
  const auto judgements = judgeThresholds({&threshold, 1}, judgedStudy());
  EXPECT_EQ(judgements.size(), 1U);
  return judgements.at(0);
}

bool holds(const Gate& threshold) {
  return judged(threshold).verdict == GateVerdict::passed;
}

Judgement judgeValue(std::optional<double> value, std::optional<double> minimum,
                     std::optional<double> maximum) {
  return judge(gate("iou", minimum, maximum), {"iou", value, value ? "" : "no shadow"});
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Judge, VerdictIsThatOfTheLimits) {
  EXPECT_EQ(judgeValue(0.03, {}, 0.03).verdict, GateVerdict::passed);
  EXPECT_EQ(judgeValue(0.0301, {}, 0.03).verdict, GateVerdict::failed);
  EXPECT_EQ(judgeValue(0.03, 0.03, {}).verdict, GateVerdict::passed);
  EXPECT_EQ(judgeValue(0.0299, 0.03, {}).verdict, GateVerdict::failed);
  EXPECT_EQ(judgeValue(0.5, 0.6, 0.7).verdict, GateVerdict::failed);
  EXPECT_EQ(judgeValue(0.8, 0.6, 0.7).verdict, GateVerdict::failed);
}

TEST(Judge, NothingPassesForWantOfANumber) {
  for (const double value : {nan, infinity, -infinity}) {
    const Judgement judgement = judgeValue(value, {}, 1);
    EXPECT_EQ(judgement.verdict, GateVerdict::undefined);
    EXPECT_EQ(judgement.value, std::nullopt);
    EXPECT_EQ(judgement.reason, "it is not a finite number");
  }
  EXPECT_EQ(judgeValue({}, {}, 1).verdict, GateVerdict::undefined);
  EXPECT_EQ(judgeValue({}, {}, infinity).reason, "no shadow");
  EXPECT_EQ(judgeValue(0.5, {}, {}).verdict, GateVerdict::failed) << "no limit";
  EXPECT_EQ(judgeValue(0.5, {}, nan).verdict, GateVerdict::failed);
  EXPECT_EQ(judgeValue(0.5, nan, {}).verdict, GateVerdict::failed);
}

/// Whatever a gate comes from, the same value under the same limit has the same verdict.
TEST(Judge, DoesNotAskWhereAGateComesFrom) {
  for (const double value : {0.02, 0.03, 0.04}) {
    Gate one = gate("iou", {}, 0.03);
    const GateVerdict verdict = judge(one, {"iou", value, {}}).verdict;
    one.origin = Reference{0.02, 0.001, 0.01};
    EXPECT_EQ(judge(one, {"iou", value, {}}).verdict, verdict);
    one.origin = CompareOption{"--max iou=0.03"};
    EXPECT_EQ(judge(one, {"iou", value, {}}).verdict, verdict);
  }
}

TEST(Thresholds, HoldUpToAndIncludingTheirLimits) {
  EXPECT_TRUE(holds(gate("error_rate", {}, 0.06)));
  EXPECT_TRUE(holds(gate("error_rate", {}, 0.05)));
  EXPECT_FALSE(holds(gate("error_rate", {}, 0.0499)));
  EXPECT_TRUE(holds(gate("error_rate", 0.05, {})));
  EXPECT_FALSE(holds(gate("error_rate", 0.0501, {})));
}

TEST(Thresholds, WithTwoLimitsMeetBoth) {
  EXPECT_TRUE(holds(gate("false_light", 0.03, 0.03)));
  EXPECT_FALSE(holds(gate("false_light", 0.01, 0.02)));
  EXPECT_FALSE(holds(gate("false_light", 0.04, 0.05)));
}

TEST(Thresholds, RecordWhatWasJudged) {
  const Gate asked{"", "", "", "all", "false_shadow", {}, 0.5, Threshold{17}};
  const Judgement judgement = judgeThresholds({&asked, 1}, judgedStudy()).front();
  EXPECT_EQ(judgement.gate.method, "a");
  EXPECT_EQ(judgement.gate.light, "noon");
  EXPECT_EQ(judgement.gate.view, "camera");
  EXPECT_EQ(judgement.gate.region, "all");
  EXPECT_EQ(judgement.gate.metric, compare::metrics::falseShadow);
  EXPECT_EQ(judgement.gate.step, "study");
  EXPECT_EQ(judgement.value, 0.02);
  EXPECT_EQ(judgement.gate.minimum, std::nullopt);
  EXPECT_EQ(judgement.gate.maximum, 0.5);
  EXPECT_EQ(std::get<Threshold>(judgement.gate.origin).line, 17);
}

TEST(Thresholds, FailOnAnUndefinedMetricWhateverTheLimit) {
  Gate empty = gate("error_rate", {}, 1);
  empty.region = "distant";
  EXPECT_FALSE(holds(empty));
  EXPECT_EQ(judged(empty).value, std::nullopt);
  empty.maximum = infinity;
  EXPECT_FALSE(holds(empty));
  Gate noShadow = gate("iou", 0, {});
  noShadow.light = "dusk";
  EXPECT_FALSE(holds(noShadow));
}

TEST(Thresholds, FailOnALimitThatIsNoNumber) {
  EXPECT_FALSE(holds(gate("error_rate", {}, nan)));
  EXPECT_FALSE(holds(gate("error_rate", nan, {})));
}

TEST(Thresholds, LeftFreeGateEveryRowThatMatches) {
  Gate anyLight = gate("error_rate", {}, 0.01);
  anyLight.light.clear();
  auto judgements = judgeThresholds({&anyLight, 1}, judgedStudy());
  ASSERT_EQ(judgements.size(), 2U);
  EXPECT_EQ(judgements[0].verdict, GateVerdict::failed);
  EXPECT_EQ(judgements[1].verdict, GateVerdict::passed);

  const Gate anything{"", "", "", "", "error_rate", {}, 0.01};
  judgements = judgeThresholds({&anything, 1}, judgedStudy());
  ASSERT_EQ(judgements.size(), 4U);
  EXPECT_EQ(judgements[3].gate.method, "b");
}

TEST(Thresholds, ThatMatchNothingAreAFault) {
  for (const Gate& threshold :
       {Gate{"c", "", "", "all", "iou", 0.5, {}}, Gate{"b", "dusk", "", "all", "iou", 0.5, {}},
        Gate{"", "", "atlas", "all", "iou", 0.5, {}}}) {
    EXPECT_THAT(messageOf<InputError>([&] { (void)judged(threshold); }),
                HasSubstr("threshold on iou of \"" + threshold.method + "\": no result matches"));
  }
  const Gate any = gate("iou", 0.5, {});
  EXPECT_THROW((void)judgeThresholds({&any, 1}, {}), InputError);
}

TEST(Thresholds, NoneGiveNoJudgements) {
  EXPECT_TRUE(judgeThresholds({}, judgedStudy()).empty());
}

TEST(Thresholds, OneThatFailsFailsTheStudy) {
  StudyRecord study;
  EXPECT_EQ(study.status(), RunStatus::notJudged);
  study.judgements = {judged(gate("error_rate", {}, 0.06))};
  EXPECT_EQ(study.status(), RunStatus::pass);
  study.judgements.push_back(judged(gate("error_rate", {}, 0.04)));
  EXPECT_EQ(study.status(), RunStatus::fail);
}

}  // namespace
}  // namespace gnomon::study
