#include "study/record/gate_record.h"

#include <gtest/gtest.h>

#include <limits>

namespace gnomon {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

GateRecord gateOn(std::optional<double> value, std::optional<double> minimum,
                  std::optional<double> maximum) {
  GateRecord record;
  record.value = value;
  record.minimum = minimum;
  record.maximum = maximum;
  record.verdict = verdictOf(record);
  return record;
}

TEST(GateRecord, MarginIsTheDistanceFromTheNearestLimit) {
  EXPECT_DOUBLE_EQ(*gateOn(0.02, {}, 0.03).margin(), 0.01);
  EXPECT_DOUBLE_EQ(*gateOn(0.05, {}, 0.03).margin(), -0.02);
  EXPECT_DOUBLE_EQ(*gateOn(0.5, 0.25, {}).margin(), 0.25);
  EXPECT_DOUBLE_EQ(*gateOn(0.5, 0.25, 0.625).margin(), 0.125);
  EXPECT_DOUBLE_EQ(*gateOn(0.125, 0.25, 0.625).margin(), -0.125);
  EXPECT_EQ(gateOn({}, 0, 1).margin(), std::nullopt);
}

TEST(GateRecord, VerdictIsThatOfTheLimits) {
  EXPECT_EQ(gateOn(0.03, {}, 0.03).verdict, GateVerdict::passed);
  EXPECT_EQ(gateOn(0.0301, {}, 0.03).verdict, GateVerdict::failed);
  EXPECT_EQ(gateOn(0.03, 0.03, {}).verdict, GateVerdict::passed);
  EXPECT_EQ(gateOn(0.0299, 0.03, {}).verdict, GateVerdict::failed);
  EXPECT_EQ(gateOn(0.5, 0.6, 0.7).verdict, GateVerdict::failed);
  EXPECT_EQ(gateOn(0.8, 0.6, 0.7).verdict, GateVerdict::failed);
}

TEST(GateRecord, NothingPassesForWantOfANumber) {
  EXPECT_EQ(gateOn({}, {}, 1).verdict, GateVerdict::undefined);
  EXPECT_EQ(gateOn(nan, {}, 1).verdict, GateVerdict::undefined);
  EXPECT_EQ(gateOn(-infinity, {}, 1).verdict, GateVerdict::undefined);
  EXPECT_EQ(gateOn(0.5, {}, {}).verdict, GateVerdict::failed) << "no limit";
  EXPECT_EQ(gateOn(0.5, {}, nan).verdict, GateVerdict::failed);
  EXPECT_EQ(gateOn(0.5, nan, {}).verdict, GateVerdict::failed);
}

TEST(GateRecord, OfAThresholdKeepsItsLineAndReason) {
  const ThresholdRecord threshold{"a", "dusk", "camera", "all",       "iou", {},
                                  0.5, {},     false,    "no shadow", 17};
  const GateRecord record = gateOf(threshold, "study");
  EXPECT_EQ(record.kind, GateKind::threshold);
  EXPECT_EQ(record.step, "study");
  EXPECT_EQ(record.verdict, GateVerdict::undefined);
  EXPECT_EQ(record.reason, "no shadow");
  EXPECT_EQ(record.line, 17);
  EXPECT_EQ(record.minimum, 0.5);
}

TEST(GateRecord, OfANanHasNoValueButAReason) {
  const ThresholdRecord threshold{"a", "", "", "all", "iou", nan, {}, 0.5, true};
  const GateRecord record = gateOf(threshold, "study");
  EXPECT_EQ(record.verdict, GateVerdict::undefined);
  EXPECT_EQ(record.value, std::nullopt);
  EXPECT_EQ(record.reason, "it is not a finite number");
}

CheckRecord check(std::vector<GateVerdict> verdicts, std::vector<ExitStatus> problems = {}) {
  CheckRecord record;
  for (const GateVerdict verdict : verdicts) {
    record.gates.emplace_back();
    record.gates.back().verdict = verdict;
  }
  for (const ExitStatus status : problems) record.problems.push_back({"study", status, "why"});
  return record;
}

TEST(CheckRecord, PassesOnlyWithAGateThatPassed) {
  using enum GateVerdict;
  EXPECT_EQ(check({passed, skipped}).status(), ExitStatus::pass);
  EXPECT_EQ(check({}).status(), ExitStatus::thresholdFailed);
  EXPECT_EQ(check({skipped}).status(), ExitStatus::thresholdFailed);
  EXPECT_EQ(check({passed, failed}).status(), ExitStatus::thresholdFailed);
  EXPECT_EQ(check({passed, undefined}).status(), ExitStatus::thresholdFailed);
}

/// A run and its check have one notion of what passes.
TEST(RunStatus, IsTheChecks) {
  using enum GateVerdict;
  const auto status = [](const CheckRecord& check) {
    StudyRecord run;
    run.references = check.gates;
    run.problems = check.problems;
    EXPECT_EQ(run.status() == RunStatus::pass, check.status() == ExitStatus::pass);
    return run.status();
  };
  EXPECT_EQ(status(check({passed, skipped})), RunStatus::pass);
  EXPECT_EQ(status(check({})), RunStatus::notJudged);
  EXPECT_EQ(status(check({skipped})), RunStatus::notJudged);
  EXPECT_EQ(status(check({passed, failed})), RunStatus::fail);
  EXPECT_EQ(status(check({passed, undefined})), RunStatus::fail);
  EXPECT_EQ(status(check({passed}, {ExitStatus::badInput})), RunStatus::fail);
}

TEST(RunStatus, HoldsThresholdsAndReferences) {
  StudyRecord run;
  run.name = "study";
  run.thresholds = {{"a", "dusk", "camera", "all", "iou", 0.6, 0.5, {}, true}};
  EXPECT_EQ(run.status(), RunStatus::pass);
  run.references = {gateOn(0.4, {}, 0.3)};
  run.references[0].kind = GateKind::reference;
  EXPECT_EQ(run.status(), RunStatus::fail);
  ASSERT_EQ(gatesOf(run).size(), 2U);
  EXPECT_EQ(gatesOf(run)[0].step, "study");
  EXPECT_EQ(gatesOf(run)[1].kind, GateKind::reference);
}

TEST(CheckRecord, HasTheLargestStatus) {
  using enum GateVerdict;
  EXPECT_EQ(check({passed}, {ExitStatus::badInput}).status(), ExitStatus::badInput);
  EXPECT_EQ(check({failed}, {ExitStatus::badInput, ExitStatus::usage}).status(),
            ExitStatus::badInput);
  EXPECT_EQ(check({}, {ExitStatus::badInput, ExitStatus::internal}).status(), ExitStatus::internal);
  EXPECT_EQ(check({failed}, {ExitStatus::noGl}).status(), ExitStatus::noGl);
}

}  // namespace
}  // namespace gnomon
