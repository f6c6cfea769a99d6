#include "model/pane_figures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "common/error.h"
#include "compare/answer_metrics.h"

namespace gnomon::app {
namespace {

constexpr int paneWidth = 40;
constexpr int paneHeight = 30;
constexpr std::size_t paneSamples = paneWidth * paneHeight;

struct Masks {
  Mask candidate{paneWidth, paneHeight, {}};
  Mask truth{paneWidth, paneHeight, {}};
};

/// A third background; the rest at random, mostly alike.
Masks randomMasks() {
  std::mt19937 random(5);
  Masks masks;
  for (std::size_t i = 0; i < paneSamples; ++i) {
    const bool background = i % 3 == 0;
    const Shade truth = random() % 2 == 0 ? Shade::lit : Shade::shadowed;
    const bool wrong = random() % 8 == 0;
    const Shade other = truth == Shade::lit ? Shade::shadowed : Shade::lit;
    masks.truth.samples.push_back(background ? Shade::none : truth);
    masks.candidate.samples.push_back(background ? Shade::none : wrong ? other : truth);
  }
  return masks;
}

TEST(PaneFigures, OfAWholeTruthAreThoseOfTheComparison) {
  const Masks masks = randomMasks();
  const std::vector<std::uint8_t> all(paneSamples, 1);
  const PaneFigures figures = paneFigures(masks.candidate, masks.truth, all);
  const compare::Counts counts = compare::countSamples(masks.candidate, masks.truth);
  EXPECT_EQ(figures.errorRate.value, compare::rate(counts, "error_rate").value);
  EXPECT_EQ(figures.falseShadow.value, compare::rate(counts, "false_shadow").value);
  EXPECT_EQ(figures.falseLight.value, compare::rate(counts, "false_light").value);
  EXPECT_EQ(figures.iou.value, compare::rate(counts, "iou").value);
  EXPECT_EQ(figures.tracedShare, 1);
  EXPECT_GT(figures.errorRate.value.value(), 0.05);
}

TEST(PaneFigures, OfAPartAreThoseOfThatPartAlone) {
  Masks masks = randomMasks();
  std::vector<std::uint8_t> traced(paneSamples, 0);
  Masks part = masks;
  for (std::size_t i = 0; i < paneSamples; ++i) {
    traced[i] = i % 4 == 1 ? 1 : 0;
    if (traced[i] != 0) continue;
    part.candidate.samples[i] = part.truth.samples[i] = Shade::none;
    masks.truth.samples[i] = Shade::lit;  // whatever stands there
  }
  const PaneFigures figures = paneFigures(masks.candidate, masks.truth, traced);
  const compare::Counts counts = compare::countSamples(part.candidate, part.truth);
  EXPECT_EQ(figures.errorRate.value, compare::rate(counts, "error_rate").value);
  EXPECT_EQ(figures.iou.value, compare::rate(counts, "iou").value);
  EXPECT_NEAR(figures.tracedShare, 0.25, 0.01);
  EXPECT_NEAR(figures.falseShadow.value.value() + figures.falseLight.value.value(),
              figures.errorRate.value.value(), 1e-15);
}

/// A third background, which neither has; the rest at random.
std::pair<Visibility, Visibility> randomShares() {
  std::mt19937 random(6);
  const auto share = [&] { return static_cast<float>(random() % 257) / 256; };
  Visibility candidate{paneWidth, paneHeight, {}};
  Visibility truth = candidate;
  for (std::size_t i = 0; i < paneSamples; ++i) {
    candidate.shares.push_back(i % 3 == 0 ? noSample : share());
    truth.shares.push_back(i % 3 == 0 ? noSample : share());
  }
  return {candidate, truth};
}

TEST(PaneFigures, OfSharesAreTheMeanErrorAndItsParts) {
  const auto [candidate, truth] = randomShares();
  std::vector<std::uint8_t> traced(paneSamples, 0);
  double dark = 0;
  double light = 0;
  double count = 0;
  for (std::size_t i = 0; i < paneSamples; ++i) {
    traced[i] = i % 4 != 0 ? 1 : 0;
    if (traced[i] == 0 || i % 3 == 0) continue;
    const double off =
        static_cast<double>(candidate.shares[i]) - static_cast<double>(truth.shares[i]);
    (off < 0 ? dark : light) += std::abs(off);
    ++count;
  }
  const PaneFigures figures = paneFigures(candidate, truth, traced);
  EXPECT_TRUE(figures.isSoft);
  EXPECT_NEAR(figures.errorRate.value.value(), (dark + light) / count, 1e-12);
  EXPECT_NEAR(figures.falseShadow.value.value(), dark / count, 1e-12);
  EXPECT_NEAR(figures.falseLight.value.value(), light / count, 1e-12);
  EXPECT_NEAR(figures.tracedShare, 0.75, 0.01);
  // Of all samples it is the run's metric.
  const std::vector<std::uint8_t> all(paneSamples, 1);
  EXPECT_EQ(paneFigures(candidate, truth, all).errorRate.value,
            compare::metricNamed(compare::shareMetrics(candidate, truth), "mae").value);
  // Shares of 0 and 1 are a mask's.
  const Masks masks = randomMasks();
  const PaneFigures hard = paneFigures(masks.candidate, masks.truth, traced);
  const PaneFigures same = paneFigures(asShares(masks.candidate), asShares(masks.truth), traced);
  EXPECT_EQ(same.errorRate.value, hard.errorRate.value);
  EXPECT_EQ(same.iou.value, hard.iou.value);
  EXPECT_FALSE(hard.isSoft);
  EXPECT_THROW(paneFigures(masks.candidate, truth, traced), InternalError);
}

TEST(PaneFigures, CountAreasWhereTheyAreGiven) {
  const Masks masks = randomMasks();
  const std::vector<std::uint8_t> all(paneSamples, 1);
  std::vector<double> areas;
  for (std::size_t i = 0; i < paneSamples; ++i) areas.push_back(static_cast<double>(i % 7));
  EXPECT_EQ(paneFigures(masks.candidate, masks.truth, all, areas).errorRate.value,
            compare::rate(compare::countSamples(masks.candidate, masks.truth, areas), "error_rate")
                .value);
}

/// A rectangle of columns 10 to 29 and rows 6 to 20, counted sample by sample.
const ViewPart middlePart{0.25, 0.2, 0.75, 0.7};
bool isInPart(std::size_t i) {
  const std::size_t column = i % paneWidth;
  const std::size_t row = i / paneWidth;
  return column >= 10 && column < 30 && row >= 6 && row < 21;
}

TEST(PaneFigures, OfARectangleAreThoseOfItsSamplesAlone) {
  const Masks masks = randomMasks();
  std::vector<std::uint8_t> traced(paneSamples, 1);
  std::size_t asked = 0;
  std::size_t count = 0;
  double dark = 0;
  double light = 0;
  for (std::size_t i = 0; i < paneSamples; ++i) {
    traced[i] = i % 5 != 0 ? 1 : 0;
    if (!isInPart(i) || masks.truth.samples[i] == Shade::none) continue;
    ++asked;
    if (traced[i] == 0) continue;
    ++count;
    if (masks.candidate.samples[i] == masks.truth.samples[i]) continue;
    (masks.truth.samples[i] == Shade::lit ? dark : light) += 1;
  }
  const PaneFigures figures = paneFigures(masks.candidate, masks.truth, traced, middlePart);
  EXPECT_EQ(figures.samples, count);
  EXPECT_EQ(figures.wrong, dark + light);
  EXPECT_EQ(figures.errorRate.value, (dark + light) / static_cast<double>(count));
  EXPECT_EQ(figures.falseShadow.value, dark / static_cast<double>(count));
  EXPECT_EQ(figures.falseLight.value, light / static_cast<double>(count));
  EXPECT_EQ(figures.tracedShare, static_cast<double>(count) / static_cast<double>(asked));
  EXPECT_GT(dark, 0);
  EXPECT_GT(light, 0);
  // The control: the whole view has another error.
  EXPECT_NE(figures.errorRate.value,
            paneFigures(masks.candidate, masks.truth, traced).errorRate.value);
}

TEST(PaneFigures, OfARectangleUnderADiscAreMeansOverIt) {
  const auto [candidate, truth] = randomShares();
  const std::vector<std::uint8_t> all(paneSamples, 1);
  double off = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < paneSamples; ++i) {
    if (!isInPart(i) || !isAnswer(truth.shares[i])) continue;
    off +=
        std::abs(static_cast<double>(candidate.shares[i]) - static_cast<double>(truth.shares[i]));
    ++count;
  }
  const PaneFigures figures = paneFigures(candidate, truth, all, middlePart);
  EXPECT_EQ(figures.samples, count);
  EXPECT_NEAR(figures.wrong, off, 1e-9);
  EXPECT_NEAR(figures.errorRate.value.value(), off / static_cast<double>(count), 1e-12);
}

TEST(PaneFigures, OfRectanglesThatFillTheViewAddUpToThoseOfTheView) {
  const Masks masks = randomMasks();
  const std::vector<std::uint8_t> all(paneSamples, 1);
  const PaneFigures whole = paneFigures(masks.candidate, masks.truth, all);
  EXPECT_EQ(paneFigures(masks.candidate, masks.truth, all, ViewPart{}).errorRate.value,
            whole.errorRate.value);
  std::size_t samples = 0;
  double wrong = 0;
  for (const ViewPart& piece : {ViewPart{0, 0, 0.3, 1}, {0.3, 0, 1, 0.41}, {0.3, 0.41, 1, 1}}) {
    const PaneFigures figures = paneFigures(masks.candidate, masks.truth, all, piece);
    samples += figures.samples;
    wrong += figures.wrong;
  }
  EXPECT_EQ(samples, whole.samples);
  EXPECT_EQ(wrong, whole.wrong);
  EXPECT_EQ(whole.wrong, std::round(whole.errorRate.value.value() * static_cast<double>(samples)));
}

TEST(PaneFigures, AreUndefinedBeforeAnythingIsTraced) {
  const Masks masks = randomMasks();
  const PaneFigures figures =
      paneFigures(masks.candidate, masks.truth, std::vector<std::uint8_t>(paneSamples, 0));
  EXPECT_FALSE(figures.errorRate.value);
  EXPECT_FALSE(figures.errorRate.reason.empty());
  EXPECT_EQ(figures.tracedShare, 0);
}

TEST(PaneFigures, LeaveOutWhatTheTruthHasNoFrameForAndRefuseWhatOnlyTheMethodLeavesOut) {
  Masks masks = randomMasks();
  const std::vector<std::uint8_t> all(paneSamples, 1);
  masks.truth.samples[1] = Shade::none;
  EXPECT_EQ(paneFigures(masks.candidate, masks.truth, all).tracedShare, 1);
  masks.candidate.samples[2] = Shade::none;
  EXPECT_THROW(paneFigures(masks.candidate, masks.truth, all), InputError);
  EXPECT_THROW(paneFigures(masks.candidate, masks.truth, std::vector<std::uint8_t>(3, 1)),
               InputError);
}

}  // namespace
}  // namespace gnomon::app
