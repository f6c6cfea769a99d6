#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "common/error.h"
#include "compare/answer_metrics.h"
#include "compare/boundaries.h"
#include "study/record/cases.h"
#include "study/record/gate.h"
#include "study/record/record.h"

namespace gnomon::study {
namespace {

using compare::MetricId;
using compare::MetricKind;

Judgement judgementOf(std::optional<double> value, std::optional<double> minimum,
                      std::optional<double> maximum) {
  return {{"", "", "", "", "error_rate", minimum, maximum}, GateVerdict::undefined, value};
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

ResultRecord measured() {
  ResultRecord result{"m", "l", "v", "all", {270, 20, 30, 680, 1000}};
  result.lengths = compare::ShadowLengths{40, 1.25, 1.0, 1.5, 8.0};
  for (const MetricId id : compare::metricsOfKinds({MetricKind::boundary})) {
    result.boundaries.push_back({id, 0.25, {}});
  }
  for (const MetricId id : compare::metricsOfKinds({MetricKind::share, MetricKind::penumbra})) {
    result.shares.push_back({id, 0.125, {}});
  }
  return result;
}

TEST(ResultMetrics, AreRatesBoundariesLengthsAndShares) {
  const auto metrics = metricsOf(measured());
  ASSERT_EQ(metrics.size(), compare::allMetrics().size());
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    EXPECT_EQ(metrics[i].id, compare::allMetrics()[i]);
    EXPECT_TRUE(metrics[i].value) << metrics[i].name();
    EXPECT_EQ(metricOf(measured(), metrics[i].id).value, metrics[i].value);
  }
  EXPECT_EQ(metricOf(measured(), "error_rate").value, 0.05);
  EXPECT_EQ(metricOf(measured(), "assd").value, 0.25);
  EXPECT_EQ(metricOf(measured(), "shadow_length_ratio").value, 1.25);
  EXPECT_EQ(metricOf(measured(), "shadow_length_q1").value, 1.0);
  EXPECT_EQ(metricOf(measured(), "shadow_length_q3").value, 1.5);
  EXPECT_EQ(metricOf(measured(), "shadow_runs").value, 40);
}

TEST(ResultMetrics, OfRegionsAreRatesAloneAndSayWhy) {
  ResultRecord region = measured();
  region.lengths.reset();
  region.boundaries.clear();
  region.shares.clear();
  for (const MetricId id : compare::allMetrics()) {
    if (id.kind() == MetricKind::rate) continue;
    const compare::Metric metric = metricOf(region, id);
    EXPECT_EQ(metric.id, id);
    EXPECT_EQ(metric.value, std::nullopt);
    const bool isShare = id.kind() == MetricKind::share || id.kind() == MetricKind::penumbra;
    EXPECT_EQ(metric.reason, isShare ? "measured over all samples together under a soft light only"
                                     : "measured over all samples together only");
  }
  EXPECT_EQ(metricsOf(region).size(), compare::allMetrics().size() - 9)
      << "no row of a point light has them";
  EXPECT_EQ(metricOf(region, "error_rate").value, 0.05);
}

TEST(ResultMetrics, AreUncertainByWhatTheCoarserTruthIsOff) {
  UncertaintyRecord truth{"v", "l", 0.5, 0.125, {}};
  for (const MetricId id : compare::metricsOfKinds({MetricKind::boundary})) {
    EXPECT_EQ(metricUncertainty(truth, id), std::numeric_limits<double>::infinity());
  }
  truth.boundaries = measured().boundaries;
  EXPECT_EQ(metricUncertainty(truth, "assd"), 0.25);
  EXPECT_EQ(metricUncertainty(truth, "hd95"), 0.25);
  EXPECT_EQ(metricUncertainty(truth, "boundary_iou_1"), 0.75);
  EXPECT_EQ(metricUncertainty(truth, "surface_dice_4"), 0.75);
  EXPECT_EQ(metricUncertainty(truth, "shadow_length_ratio"), 0.125);
  EXPECT_EQ(metricUncertainty(UncertaintyRecord{}, "shadow_length_ratio"), 0);
  EXPECT_EQ(metricUncertainty(truth, "rmse"), std::numeric_limits<double>::infinity());
  truth.shares = measured().shares;
  EXPECT_EQ(metricUncertainty(truth, "mae"), 0.125);
  EXPECT_EQ(metricUncertainty(truth, "penumbra_iou"), 0.875);
  EXPECT_THROW((void)metricUncertainty(truth, "error_rate"), InternalError);
}

}  // namespace
}  // namespace gnomon::study
