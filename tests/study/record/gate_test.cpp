#include "study/record/gate.h"

#include <gtest/gtest.h>

#include "study/record/check_record.h"
#include "study/record/record.h"

namespace gnomon::study {
namespace {

Judgement judgementOf(std::optional<double> value, std::optional<double> minimum,
                      std::optional<double> maximum) {
  return {{"", "", "", "", "", minimum, maximum}, GateVerdict::undefined, value};
}

TEST(Judgement, MarginIsTheDistanceFromTheNearestLimit) {
  EXPECT_DOUBLE_EQ(*judgementOf(0.02, {}, 0.03).margin(), 0.01);
  EXPECT_DOUBLE_EQ(*judgementOf(0.05, {}, 0.03).margin(), -0.02);
  EXPECT_DOUBLE_EQ(*judgementOf(0.5, 0.25, {}).margin(), 0.25);
  EXPECT_DOUBLE_EQ(*judgementOf(0.5, 0.25, 0.625).margin(), 0.125);
  EXPECT_DOUBLE_EQ(*judgementOf(0.125, 0.25, 0.625).margin(), -0.125);
  EXPECT_EQ(judgementOf({}, 0, 1).margin(), std::nullopt);
}

TEST(Judgement, IsFoundByItsOrigin) {
  std::vector<Judgement> judgements(3);
  judgements[1].gate.origin = Reference{0.5, 0.1, 0.2};
  judgements[2].gate.method = "last";
  const auto [thresholds, references, options] = byOrigin(judgements);
  ASSERT_EQ(thresholds.size(), 2U);
  EXPECT_EQ(thresholds[1].gate.method, "last");
  EXPECT_EQ(references.size(), 1U);
  EXPECT_TRUE(options.empty());
}

TEST(Gate, HasACommittedValueWhereItIsAReference) {
  Gate gate;
  EXPECT_EQ(committedValue(gate), std::nullopt);
  gate.origin = Reference{0.5, 0.1, 0.2};
  EXPECT_EQ(committedValue(gate), 0.5);
  gate.origin = CompareOption{"--max error_rate=0.02"};
  EXPECT_EQ(committedValue(gate), std::nullopt);
}

CheckRecord check(std::vector<GateVerdict> verdicts, std::vector<ExitStatus> problems = {}) {
  CheckRecord record;
  for (const GateVerdict verdict : verdicts) {
    record.judgements.push_back({{}, verdict});
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
    run.judgements = check.judgements;
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

TEST(CheckRecord, HasTheLargestStatus) {
  using enum GateVerdict;
  EXPECT_EQ(check({passed}, {ExitStatus::badInput}).status(), ExitStatus::badInput);
  EXPECT_EQ(check({failed}, {ExitStatus::badInput, ExitStatus::usage}).status(),
            ExitStatus::badInput);
  EXPECT_EQ(check({}, {ExitStatus::badInput, ExitStatus::internal}).status(), ExitStatus::internal);
  EXPECT_EQ(check({failed}, {ExitStatus::noGl}).status(), ExitStatus::noGl);
}

}  // namespace
}  // namespace gnomon::study
