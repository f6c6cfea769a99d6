#include "study/record/result_metrics.h"

#include <gtest/gtest.h>

#include <limits>

#include "common/error.h"

namespace gnomon::study {
namespace {

using compare::MetricId;
using compare::MetricKind;

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
