#include "study/record/result_metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "common/error.h"
#include "compare/boundaries.h"
#include "compare/share_metrics.h"

namespace gnomon::study {
namespace {

ResultRecord measured() {
  ResultRecord result{"m", "l", "v", "all", {270, 20, 30, 680, 1000}};
  result.lengths = compare::ShadowLengths{40, 1.25, 1.0, 1.5, 8.0};
  for (const std::string_view name : compare::boundaryMetricNames()) {
    result.boundaries.push_back({name, 0.25, {}});
  }
  for (const std::string_view name : compare::shareMetricNames()) {
    result.shares.push_back({name, 0.125, {}});
  }
  return result;
}

TEST(ResultMetrics, AreRatesBoundariesLengthsAndShares) {
  const auto metrics = metricsOf(measured());
  ASSERT_EQ(metrics.size(), metricNames().size());
  ASSERT_EQ(metrics.size(), compare::rateNames().size() + 8 + 4 + 9);
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    EXPECT_EQ(metrics[i].name, metricNames()[i]);
    EXPECT_TRUE(metrics[i].value) << metrics[i].name;
    EXPECT_EQ(metricOf(measured(), metrics[i].name).value, metrics[i].value);
    EXPECT_EQ(isRate(metrics[i].name), i < compare::rateNames().size());
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
  for (const std::string_view name : metricNames()) {
    if (isRate(name)) continue;
    const compare::Metric metric = metricOf(region, name);
    EXPECT_EQ(metric.name, name);
    EXPECT_EQ(metric.value, std::nullopt);
    const auto& ofShares = compare::shareMetricNames();
    const bool isShare = std::find(ofShares.begin(), ofShares.end(), name) != ofShares.end();
    EXPECT_EQ(metric.reason, isShare ? "measured over all samples together under a soft light only"
                                     : "measured over all samples together only");
  }
  EXPECT_EQ(metricsOf(region).size(), metricNames().size() - 9)
      << "no row of a point light has them";
  EXPECT_EQ(metricOf(region, "error_rate").value, 0.05);
}

TEST(ResultMetrics, AreUncertainByWhatTheCoarserTruthIsOff) {
  UncertaintyRecord truth{"v", "l", 0.5, 0.125, {}};
  for (const std::string_view name : compare::boundaryMetricNames()) {
    EXPECT_EQ(metricUncertainty(truth, name), std::numeric_limits<double>::infinity());
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

TEST(ResultMetrics, RefuseOtherNames) {
  EXPECT_THROW((void)metricOf(measured(), "shadow_length"), InternalError);
}

}  // namespace
}  // namespace gnomon::study
