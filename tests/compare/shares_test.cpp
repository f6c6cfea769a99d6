#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <span>
#include <vector>

#include "common/error.h"
#include "compare/answer_metrics.h"
#include "compare/confidence_interval.h"
#include "compare/counts.h"
#include "compare/masks.h"
#include "compare/worst_windows.h"
#include "support/error_messages.h"

namespace gnomon::compare {
namespace {

using test::arbitraryComparison;
using test::Comparison;

bool areSameCounts(const Counts& a, const Counts& b) {
  return a.truePositive == b.truePositive && a.falsePositive == b.falsePositive &&
         a.falseNegative == b.falseNegative && a.trueNegative == b.trueNegative &&
         a.samples == b.samples;
}

Visibility mapRow(std::vector<float> shares) {
  return {static_cast<int>(shares.size()), 1, std::move(shares)};
}

/// Two maps of one view with weights; a fifth of the samples background.
struct MapPair {
  Visibility candidate, truth;
  std::vector<double> weights;
};
MapPair arbitraryMaps() {
  MapPair maps;
  const int width = *rc::gen::inRange(1, 20);
  const int height = *rc::gen::inRange(1, 20);
  maps.candidate = {width, height, {}};
  maps.truth = {width, height, {}};
  for (int i = 0; i < width * height; ++i) {
    const bool background = *rc::gen::inRange(0, 5) == 0;
    const auto share = [&] {
      const auto value = static_cast<float>(*rc::gen::inRange(0, 257)) / 256.0F;
      return background ? noSample : value;
    };
    maps.candidate.shares.push_back(share());
    maps.truth.shares.push_back(share());
    maps.weights.push_back(*rc::gen::inRange(0, 1000));
  }
  return maps;
}

TEST(ShareCounts, OfZerosAndOnesAreTheMasksToTheBit) {
  EXPECT_TRUE(rc::check("counts, bins, blocks", [] {
    const Comparison c = arbitraryComparison();
    const Visibility candidate = asShares(c.candidate);
    const Visibility truth = asShares(c.truth);
    const auto ofMasks = countSamples(c.candidate, c.truth, c.weights, c.selected);
    const auto ofMaps = countSamples(candidate, truth, c.weights, c.selected);
    RC_ASSERT(areSameCounts(ofMasks, ofMaps));
    const auto classesOfMasks = countClasses(c.candidate, c.truth, c.selected, 3, c.weights);
    const auto classesOfMaps = countClasses(candidate, truth, c.selected, 3, c.weights);
    const auto binsOfMasks = countBins(c.candidate, c.truth, c.selected, 3, c.weights);
    const auto binsOfMaps = countBins(candidate, truth, c.selected, 3, c.weights);
    for (std::size_t i = 0; i < 3; ++i) {
      RC_ASSERT(areSameCounts(classesOfMasks[i], classesOfMaps[i]));
      RC_ASSERT(areSameCounts(binsOfMasks[i], binsOfMaps[i]));
    }
    const BlockErrors errors = blockErrors(c.candidate, c.truth, 4, c.weights, c.selected);
    const BlockErrors ofShares = blockErrors(candidate, truth, 4, c.weights, c.selected);
    RC_ASSERT(errors.wrong == ofShares.wrong);
    RC_ASSERT(errors.weight == ofShares.weight);
  }));
}

TEST(ShareCounts, GiveTheMeanErrorAndItsParts) {
  EXPECT_TRUE(rc::check("error rate, false shadow, false light, prevalence", [] {
    const MapPair maps = arbitraryMaps();
    double all = 0;
    double off = 0;
    double tooDark = 0;
    double tooLight = 0;
    double dark = 0;
    for (std::size_t i = 0; i < maps.weights.size(); ++i) {
      if (std::isnan(maps.truth.shares[i])) continue;
      const auto v = static_cast<double>(maps.candidate.shares[i]);
      const auto t = static_cast<double>(maps.truth.shares[i]);
      all += maps.weights[i];
      off += maps.weights[i] * std::abs(v - t);
      tooDark += maps.weights[i] * (v < t ? t - v : 0);
      tooLight += maps.weights[i] * (v > t ? v - t : 0);
      dark += maps.weights[i] * (1 - t);
    }
    const Counts counts = countSamples(maps.candidate, maps.truth, maps.weights);
    // Every share is a multiple of 1/256 and every weight whole: sums are exact.
    RC_ASSERT(counts.total() == all);
    RC_PRE(all > 0);
    RC_ASSERT(*rate(counts, "error_rate").value == off / all);
    RC_ASSERT(*rate(counts, "false_shadow").value == tooDark / all);
    RC_ASSERT(*rate(counts, "false_light").value == tooLight / all);
    RC_ASSERT(*rate(counts, "prevalence").value == dark / all);
    RC_ASSERT(*metricNamed(shareMetrics(maps.candidate, maps.truth, maps.weights), "mae").value ==
              off / all);
    RC_ASSERT(std::abs(blockErrors(maps.candidate, maps.truth, 3, maps.weights).rate() -
                       off / all) < 1e-12);
  }));
}

TEST(ShareCounts, OfTheComplementAreTheControl) {
  EXPECT_TRUE(rc::check("mae = mean |1 - 2V|", [] {
    const MapPair maps = arbitraryMaps();
    Visibility complement = maps.truth;
    double expected = 0;
    double all = 0;
    for (std::size_t i = 0; i < complement.size(); ++i) {
      if (std::isnan(complement.shares[i])) continue;
      complement.shares[i] = 1 - complement.shares[i];
      expected += maps.weights[i] * std::abs(1 - 2 * static_cast<double>(maps.truth.shares[i]));
      all += maps.weights[i];
    }
    RC_PRE(all > 0);
    const Counts counts = countSamples(complement, maps.truth, maps.weights);
    RC_ASSERT(*rate(counts, "error_rate").value == expected / all);
  }));
}

TEST(ShareCounts, RefuseWhatIsNoShareAndWhatOneMapLacks) {
  EXPECT_THROW((void)countSamples(mapRow({0.5F, 1.5F}), mapRow({0, 1})), InputError);
  EXPECT_THROW((void)countSamples(mapRow({0.5F, 1}), mapRow({0, -0.1F})), InputError);
  EXPECT_THROW((void)countSamples(mapRow({0.5F, noSample}), mapRow({0, 1})), InputError);
  EXPECT_THROW((void)countSamples(mapRow({0.5F}), mapRow({0, 1})), InputError);
  EXPECT_THROW(
      (void)countBins(mapRow({0.5F, noSample}), mapRow({0, 1}), std::vector<std::uint8_t>{0, 0}, 1),
      InputError);
}

TEST(ShareMetrics, ByHand) {
  // Off by 0, ¼, ½, 1/16; umbra of both 1, of either 2; penumbra of both 1, of either 3.
  const Visibility candidate = mapRow({0, 0.25F, 0.5F, 1, noSample});
  const Visibility truth = mapRow({0, 0, 1, 0.9375F, noSample});
  const std::vector<Metric> metrics = shareMetrics(candidate, truth);
  const auto value = [&](MetricId id) { return *metricNamed(metrics, id).value; };
  EXPECT_DOUBLE_EQ(value("mae"), (0.25 + 0.5 + 0.0625) / 4);
  EXPECT_DOUBLE_EQ(value("rmse"), std::sqrt((0.0625 + 0.25 + 0.00390625) / 4));
  EXPECT_DOUBLE_EQ(value("off_by_more_than_0.1"), 0.5);
  EXPECT_DOUBLE_EQ(value("umbra_iou"), 0.5);
  EXPECT_DOUBLE_EQ(value("penumbra_iou"), 0);
  const std::vector<Metric> weighted =
      shareMetrics(candidate, truth, std::vector<double>{4, 2, 1, 1, 100});
  EXPECT_DOUBLE_EQ(*metricNamed(weighted, "umbra_iou").value, 4.0 / 6);
  EXPECT_DOUBLE_EQ(*metricNamed(weighted, "off_by_more_than_0.1").value, 3.0 / 8);
  const std::vector<Metric> same = shareMetrics(truth, truth);
  for (const Metric& metric : same) EXPECT_EQ(*metric.value, metric.id.perfect());
}

TEST(ShareMetrics, OfMasksAreTheErrorRate) {
  const Visibility candidate = mapRow({0, 1, 0, 1, 1});
  const Visibility truth = mapRow({0, 0, 1, 1, 1});
  const std::vector<Metric> metrics = shareMetrics(candidate, truth);
  EXPECT_EQ(*metricNamed(metrics, "mae").value, 2.0 / 5);
  EXPECT_EQ(*metricNamed(metrics, "off_by_more_than_0.1").value, 2.0 / 5);
  EXPECT_DOUBLE_EQ(std::pow(*metricNamed(metrics, "rmse").value, 2), 2.0 / 5);
}

TEST(ShareMetrics, TheUmbraEndsAtHalfARay) {
  const Visibility rays = mapRow({0, 1.0F / 256, 255.0F / 256, 1});
  const Visibility none = mapRow({0.001F, 0.5F, 0.5F, 0.999F});
  const std::vector<Metric> metrics = shareMetrics(rays, none);
  EXPECT_EQ(*metricNamed(metrics, "umbra_iou").value, 1);
  EXPECT_EQ(*metricNamed(metrics, "penumbra_iou").value, 1);
}

TEST(ShareMetrics, WithoutAValueHaveAReasonOfTheList) {
  const Visibility lit = mapRow({1, 1});
  const Visibility nothing = mapRow({noSample, noSample});
  std::vector<Metric> metrics = shareMetrics(lit, lit);
  const std::vector<Metric> ofNothing = shareMetrics(nothing, nothing);
  const std::vector<Metric> ofNoArea = shareMetrics(lit, lit, std::vector<double>{0, 0});
  const std::vector<Metric> widths = penumbraMetrics({});
  EXPECT_FALSE(metricNamed(metrics, "umbra_iou").value);
  EXPECT_FALSE(metricNamed(metrics, "penumbra_iou").value);
  metrics.insert(metrics.end(), ofNothing.begin(), ofNothing.end());
  metrics.insert(metrics.end(), ofNoArea.begin(), ofNoArea.end());
  metrics.insert(metrics.end(), widths.begin(), widths.end());
  ShadowLengths few;
  few.runs = 3;
  EXPECT_EQ(*penumbraMetrics(few).back().value, 3);
  metrics.push_back(penumbraMetrics(few).front());
  for (const Metric& metric : metrics) {
    EXPECT_EQ(metric.value.has_value(), metric.reason.empty()) << metric.name();
    if (metric.value) continue;
    EXPECT_EQ(std::count(shareReasons().begin(), shareReasons().end(), metric.reason), 1);
  }
}

/// Rows whose V rises from 0 to 1 over `width` samples from column `begin` on.
Visibility ramps(int columns, int rows, double begin, double width) {
  Visibility map{columns, rows, {}};
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      map.shares.push_back(static_cast<float>(std::clamp((x + 0.5 - begin) / width, 0.0, 1.0)));
    }
  }
  return map;
}

TEST(PenumbraWidth, IsTheRatioOfRampsAlongTheLight) {
  LightField field{120, 40, 0, {}};
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 120; ++x) {
      field.steps.push_back({glm::vec2(1, 0), 1.0F, glm::vec3(x, y, 0), 6.0F});
    }
  }
  const auto ratio = [&](const Visibility& candidate, const Visibility& truth) {
    const std::vector<Metric> metrics =
        penumbraMetrics(compareShadowLengths(penumbraMask(candidate), penumbraMask(truth), field));
    EXPECT_EQ(*metricNamed(metrics, "penumbra_runs").value, 40);
    return *metricNamed(metrics, "penumbra_width_ratio").value;
  };
  const Visibility truth = ramps(120, 40, 40, 20);  // 10 to 90 %: columns 42 to 57, 16 samples
  EXPECT_DOUBLE_EQ(ratio(truth, truth), 1);
  EXPECT_DOUBLE_EQ(ratio(ramps(120, 40, 30, 40), truth), 2);
  EXPECT_DOUBLE_EQ(ratio(ramps(120, 40, 45, 10), truth), 0.5);
  EXPECT_DOUBLE_EQ(ratio(ramps(120, 40, 50, 1e-3), truth), 0);
}

TEST(Visibility, IsCutWhereLessThanHalfIsSeen) {
  const Mask cut = cutInHalf(mapRow({0, 0.499F, 0.5F, 1, noSample}));
  EXPECT_EQ(cut.samples, test::row("##.. ").samples);
  EXPECT_EQ(cutInHalf(asShares(test::row("#. .#"))).samples, test::row("#. .#").samples);
}

double wrongIn(const std::vector<float>& wrong, int width, const Window& window) {
  double count = 0;
  for (int y = window.top; y < window.top + window.side; ++y) {
    for (int x = window.left; x < window.left + window.side; ++x) {
      count += wrong.at(static_cast<std::size_t>(y * width + x));
    }
  }
  return count;
}

TEST(WorstWindows, FindsWhatCountingEverySquareFinds) {
  constexpr int width = 23, height = 17, side = 5;
  std::mt19937 random(1);
  std::vector<float> wrong(static_cast<std::size_t>(width * height));
  // Wrong, right, and by parts, which sums hold exactly.
  for (float& pixel : wrong) pixel = static_cast<float>(random() % 5) / 4;
  const std::vector<Window> found =
      worstWindows(std::span<const float>(wrong), width, height, side, 3);
  ASSERT_EQ(found.size(), 3U);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].error, wrongIn(wrong, width, found[i]));
    double most = 0;
    for (int y = 0; y + side <= height; ++y) {
      for (int x = 0; x + side <= width; ++x) {
        const bool isFree = std::none_of(
            found.begin(), found.begin() + static_cast<std::ptrdiff_t>(i), [&](const Window& w) {
              return std::abs(w.left - x) < side && std::abs(w.top - y) < side;
            });
        if (isFree) most = std::max(most, wrongIn(wrong, width, {x, y, side, 0}));
      }
    }
    EXPECT_EQ(found[i].error, most) << i;
  }
}

TEST(WorstWindows, NoneWithoutErrorsAndNoneBeyondThePicture) {
  EXPECT_TRUE(worstWindows(std::span<const float>(std::vector<float>(12, 0)), 4, 3, 64, 3).empty());
  EXPECT_TRUE(worstWindows(std::span<const float>(), 0, 0, 64, 3).empty());
  std::vector<float> wrong(12, 0);
  wrong[11] = 1;  // the last column of the last row
  const std::vector<Window> found = worstWindows(std::span<const float>(wrong), 4, 3, 64, 3);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].left, 1);
  EXPECT_EQ(found[0].top, 0);
  EXPECT_EQ(found[0].side, 3);
  EXPECT_EQ(found[0].error, 1);
}

TEST(WorstWindows, OfMarksAreThoseOfOnesAndZeros) {
  std::mt19937 random(3);
  std::vector<float> errors(50 * 40);
  std::vector<std::uint8_t> marks(errors.size());
  for (std::size_t i = 0; i < marks.size(); ++i) {
    marks[i] = random() % 9 == 0 ? 1 : 0;
    errors[i] = marks[i];
  }
  const auto found = worstWindows(std::span<const std::uint8_t>(marks), 50, 40, 7, 4);
  const auto expected = worstWindows(std::span<const float>(errors), 50, 40, 7, 4);
  ASSERT_EQ(found.size(), 4U);
  ASSERT_EQ(expected.size(), found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].left, expected[i].left);
    EXPECT_EQ(found[i].top, expected[i].top);
    EXPECT_EQ(found[i].error, expected[i].error);
  }
}

}  // namespace
}  // namespace gnomon::compare
