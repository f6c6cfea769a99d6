#include "compare/mask_metrics.h"

#include <gmock/gmock.h>

#include "common/error.h"
#include "compare/boundaries.h"
#include "compare/counts.h"
#include "compare/masks.h"
#include "support/error_messages.h"

namespace gnomon::compare {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;

TEST(CommonPixels, KeepsWhereTheTruthHasASampleInsideTheRegion) {
  const Mask candidate = test::row("..##.#");
  const Mask truth = test::row(".# #.#");
  const Mask roi = test::row("...# #");
  const ComparedMasks masks = commonPixels(candidate, truth, &roi);
  // Black and grey of the region of interest do not count.
  EXPECT_THAT(masks.candidate.samples, ElementsAreArray(test::row("..    ").samples));
  EXPECT_THAT(masks.truth.samples, ElementsAreArray(test::row(".#    ").samples));
  EXPECT_EQ(masks.compared, 2U);
  EXPECT_EQ(masks.withoutSample, 1U);
  EXPECT_EQ(masks.outsideRoi, 3U);
}

TEST(CommonPixels, TheCandidateMayAnswerWhereItIsNotAskedButNotTheOtherWayRound) {
  const Mask truth = test::row("  .#.#");
  const ComparedMasks masks = commonPixels(test::row(".#.##."), truth, nullptr);
  EXPECT_EQ(masks.compared, 4U);
  EXPECT_EQ(masks.candidate.samples[0], Shade::none);
  EXPECT_THAT(messageOf<InputError>([&] { commonPixels(test::row(".#. #. "), truth, nullptr); }),
              HasSubstr("7 × 1 pixels found, but the truth has 6 × 1"));
  EXPECT_THAT(messageOf<InputError>([&] { commonPixels(test::row(".#. # "), truth, nullptr); }),
              AllOf(HasSubstr("no sample at 2 of the 4 pixels"), HasSubstr("column 3, row 0")));
  const Mask roi = test::row("  . .");
  EXPECT_THAT(messageOf<InputError>([&] { commonPixels(truth, truth, &roi); }),
              HasSubstr("region of interest: 5 × 1 pixels found"));
  EXPECT_THAT(messageOf<InputError>([&] {
                const Mask region = test::row("####.#");
                commonPixels(test::row(".#.#  "), test::row("......"), &region);
              }),
              HasSubstr("no sample at 1 of the 1 pixels"));
}

TEST(CommonPixels, SaysWhyNothingIsLeft) {
  const Mask truth = test::row("  .#");
  const auto message = [&](const Mask& of, const Mask* roi) {
    return messageOf<InputError>([&] { commonPixels(of, of, roi); });
  };
  const Mask empty = test::row("    ");
  EXPECT_EQ(message(empty, nullptr), "truth: no pixel has a sample");
  const Mask dark = test::row("####");
  EXPECT_EQ(message(truth, &dark), "region of interest: no pixel is white");
  EXPECT_EQ(message(truth, &empty), "region of interest: no pixel is white");
  const Mask beside = test::row("..##");
  EXPECT_EQ(message(truth, &beside), "region of interest: the truth has no sample in it");
}

TEST(MaskMetrics, AreTheRatesAndTheBoundariesByTheirNames) {
  Mask truth = test::row("..####..........");
  truth.width = truth.height = 4;
  Mask candidate = test::row("...####.........");
  candidate.width = candidate.height = 4;
  const std::vector<Metric> metrics = maskMetrics(candidate, truth);
  const std::vector<MetricId> ids = metricsOfKinds({MetricKind::rate, MetricKind::boundary});
  ASSERT_EQ(metrics.size(), ids.size());
  for (std::size_t i = 0; i < metrics.size(); ++i) EXPECT_EQ(metrics[i].id, ids[i]);
  EXPECT_EQ(metrics[0].value, 2.0 / 16);
  const std::vector<Metric> boundaries = compareBoundaries(candidate, truth);
  EXPECT_EQ(metricNamed(metrics, "assd").value, boundaries[0].value);
  EXPECT_TRUE(boundaries[0].value);
}

}  // namespace
}  // namespace gnomon::compare
