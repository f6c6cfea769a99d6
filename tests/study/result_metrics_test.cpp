#include "study/result_metrics.h"

#include <gtest/gtest.h>

#include "common/error.h"

namespace gnomon {
namespace {

ResultRecord measured() {
  ResultRecord result{"m", "l", "v", "all", {270, 20, 30, 680, 1000}};
  result.lengths = ShadowLengths{40, 1.25, 1.0, 1.5, 8.0};
  return result;
}

TEST(ResultMetrics, AreRatesAndThenLengths) {
  const auto metrics = metricsOf(measured());
  ASSERT_EQ(metrics.size(), metricNames().size());
  ASSERT_EQ(metrics.size(), rateNames().size() + 4);
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    EXPECT_EQ(metrics[i].name, metricNames()[i]);
    EXPECT_TRUE(metrics[i].value) << metrics[i].name;
    EXPECT_EQ(metricOf(measured(), metrics[i].name).value, metrics[i].value);
    EXPECT_EQ(isLengthMetric(metrics[i].name), i >= rateNames().size());
  }
  EXPECT_EQ(metricOf(measured(), "error_rate").value, 0.05);
  EXPECT_EQ(metricOf(measured(), "shadow_length_ratio").value, 1.25);
  EXPECT_EQ(metricOf(measured(), "shadow_length_q1").value, 1.0);
  EXPECT_EQ(metricOf(measured(), "shadow_length_q3").value, 1.5);
  EXPECT_EQ(metricOf(measured(), "shadow_runs").value, 40);
}

TEST(ResultMetrics, WithoutLengthsAreUndefinedAndSayWhy) {
  ResultRecord region = measured();
  region.lengths.reset();
  for (const std::string_view name : lengthMetricNames()) {
    const Metric metric = metricOf(region, name);
    EXPECT_EQ(metric.name, name);
    EXPECT_EQ(metric.value, std::nullopt);
    EXPECT_EQ(metric.reason, "measured over all samples together only");
  }
  EXPECT_EQ(metricOf(region, "error_rate").value, 0.05);
}

TEST(ResultMetrics, RefuseOtherNames) {
  EXPECT_THROW((void)metricOf(measured(), "shadow_length"), InternalError);
}

}  // namespace
}  // namespace gnomon
