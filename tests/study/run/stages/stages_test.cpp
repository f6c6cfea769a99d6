#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "common/error.h"
#include "compare/random_errors.h"
#include "study/judge/distinguish.h"
#include "study/run/method_trial.h"
#include "study/run/stages/confidence.h"
#include "study/run/stages/cost_stage.h"
#include "study/run/stages/run_writer.h"
#include "study/run/stages/truth_pictures.h"

namespace gnomon::study {
namespace {

using testing::Each;
using testing::ElementsAre;

TEST(FrameLimits, OfAllCasesOfASweepAreThoseOfFiveAtMost) {
  for (const std::size_t cases : {1, 2, 5}) {
    EXPECT_EQ(frameLimits(25, cases).milliseconds, 100) << cases;
  }
  for (const std::size_t cases : {6, 51, 1000}) {
    const double all = frameLimits(25, cases).milliseconds * static_cast<double>(cases);
    EXPECT_DOUBLE_EQ(all, 500) << cases;
  }
}

TEST(FrameLimits, HaveTheFramesThatWereAskedFor) {
  EXPECT_EQ(frameLimits(7, 51).frames, 7);
}

constexpr int pictureWidth = 200, pictureHeight = 100;

/// Embeds a picture as its bytes.
class Bytes : public NoFiles {
 public:
  [[nodiscard]] std::string embedded(int, int, std::vector<std::uint8_t> rgb,
                                     EmbeddedSize size) const override {
    EXPECT_EQ(size, EmbeddedSize::full);
    return {rgb.begin(), rgb.end()};
  }
};

Visibility filled(float share) {
  return {pictureWidth, pictureHeight,
          std::vector<float>(std::size_t{pictureWidth} * pictureHeight, share)};
}

std::size_t placeOf(int x, int y) {
  return static_cast<std::size_t>(y) * pictureWidth + static_cast<std::size_t>(x);
}

/// A colour that tells the sample.
std::array<std::uint8_t, 3> columnAndRow(std::size_t i) {
  return {static_cast<std::uint8_t>(i % pictureWidth), static_cast<std::uint8_t>(i / pictureWidth),
          0};
}

std::array<std::uint8_t, 3> white(std::size_t) {
  return {255, 255, 255};
}

std::vector<WorstPlace> placesOf(const Visibility& answer, const Visibility& truth,
                                 const SampleColour& own, const SampleColour& right) {
  return worstPlaces(worstSquares(answer, truth), pictureWidth, own, right, Bytes());
}

TEST(WorstPlaces, ErrorsOfMasksAreThoseOfTheirShares) {
  // Every pair of answers.
  const std::vector<Shade> shades = {Shade::lit, Shade::shadowed, Shade::none};
  Mask answer{3, 3, {}};
  Mask truth{3, 3, {}};
  for (const Shade ours : shades) {
    for (const Shade theirs : shades) {
      answer.samples.push_back(ours);
      truth.samples.push_back(theirs);
    }
  }
  EXPECT_EQ(sampleErrors(asShares(answer), asShares(truth)),
            (std::vector<float>{0, 1, 0, 1, 0, 0, 0, 0, 0}));
  EXPECT_EQ(sampleErrors(answer, truth), (std::vector<std::uint8_t>{0, 1, 0, 1, 0, 0, 0, 0, 0}));
}

TEST(WorstPlaces, ShowBothPicturesWhereTheErrorIs) {
  const Visibility truth = filled(1);
  Visibility answer = truth;
  answer.shares[placeOf(199, 99)] = 0;
  answer.shares[placeOf(198, 99)] = 0.5F;
  const auto places = placesOf(answer, truth, columnAndRow, white);
  ASSERT_EQ(places.size(), 1U);
  const WorstPlace& place = places[0];
  EXPECT_EQ(place.left, pictureWidth - worstPlaceSide);
  EXPECT_EQ(place.top, pictureHeight - worstPlaceSide);
  EXPECT_EQ(place.side, worstPlaceSide);
  EXPECT_EQ(place.error, 1.5);
  ASSERT_EQ(place.answer.size(), 3U * worstPlaceSide * worstPlaceSide);
  for (const int offset : {0, worstPlaceSide * worstPlaceSide - 1}) {
    const int x = place.left + offset % worstPlaceSide;
    const int y = place.top + offset / worstPlaceSide;
    const auto at = static_cast<std::size_t>(3 * offset);
    EXPECT_EQ(static_cast<std::uint8_t>(place.answer[at]), x) << offset;
    EXPECT_EQ(static_cast<std::uint8_t>(place.answer[at + 1]), y) << offset;
  }
  EXPECT_EQ(place.truth.size(), place.answer.size());
  EXPECT_THAT(place.truth, Each('\xff'));
}

TEST(WorstPlaces, OfARightAnswerAreNone) {
  Visibility truth = filled(0.25F);
  EXPECT_TRUE(placesOf(truth, truth, white, white).empty());
  Visibility answer = truth;
  truth.shares[7] = answer.shares[7] = noSample;
  EXPECT_TRUE(placesOf(answer, truth, white, white).empty());
}

TEST(WorstPlaces, AreThreeAtMost) {
  EXPECT_EQ(placesOf(filled(0), filled(1), white, white).size(), mostWorstPlaces);
}

TEST(EncodingQueue, DoesWhatFollowsInOrderOnceAllIsEncoded) {
  StageClock clock({});
  EncodingQueue queue(clock);
  std::atomic<int> encoded = 0;
  std::vector<int> order;
  std::vector<std::thread::id> threads;
  for (int piece = 0; piece < 3; ++piece) {
    queue.add({[&] { ++encoded; }, [&] { ++encoded; }}, [&, piece] {
      EXPECT_EQ(encoded, 6);
      order.push_back(piece);
      threads.push_back(std::this_thread::get_id());
    });
  }
  EXPECT_TRUE(order.empty());
  queue.finish();
  EXPECT_THAT(order, ElementsAre(0, 1, 2));
  EXPECT_THAT(threads, testing::Each(std::this_thread::get_id()));
  queue.finish();
  EXPECT_EQ(order.size(), 3U);
  ASSERT_EQ(clock.timings().size(), 1U);
  EXPECT_EQ(clock.timings().front().stage, "writing");
}

TEST(EncodingQueue, DoesNotLetMuchWait) {
  StageClock clock({});
  EncodingQueue queue(clock);
  int done = 0;
  queue.add(
      {}, [&] { ++done; }, 60'000'000);
  EXPECT_EQ(done, 0);
  queue.add(
      {}, [&] { ++done; }, 60'000'000);
  EXPECT_EQ(done, 2);
}

constexpr int maskSide = 144;

/// Methods whose errors are the level sets of fields with much in common, under two lights.
ViewErrors someErrors() {
  const Mask truth{maskSide, maskSide,
                   std::vector<Shade>(std::size_t{maskSide} * maskSide, Shade::lit)};
  ViewErrors errors{"camera", compare::chooseTiling(truth), {"noon", "evening"}, {}};
  test::RandomFields fields(maskSide, 1, 5);
  const std::vector<float> common = fields.next();
  const auto add = [&](const std::string& method, double noon, double evening) {
    MethodErrors made{method, {}};
    for (const double rate : {noon, evening}) {
      const Mask mask = test::errorMask(test::mixed(common, fields.next(), 0.7), maskSide,
                                        test::ErrorShape::blobs, rate);
      made.lights.push_back(compare::blockErrors(mask, truth, errors.tiling.cellSide));
    }
    errors.methods.push_back(made);
  };
  add("rough", 0.2, 0.3);
  add("fine", 0.02, 0.03);
  add("close", 0.02, 0.03);
  return errors;
}

TEST(ConfidenceOf, SpeaksOfAllLightsAndOfEach) {
  const ViewErrors errors = someErrors();
  const std::vector<ConfidenceRecord> records = confidenceOf(errors);
  ASSERT_EQ(records.size(), 9U);
  EXPECT_EQ(records[0].method, "rough");
  EXPECT_EQ(records[0].view, "camera");
  EXPECT_EQ(records[0].light, "all");
  EXPECT_EQ(records[1].light, "noon");
  EXPECT_EQ(records[2].light, "evening");
  EXPECT_EQ(records[3].method, "fine");
  EXPECT_DOUBLE_EQ(records[0].rate, (records[1].rate + records[2].rate) / 2);
  EXPECT_DOUBLE_EQ(records[1].rate, errors.methods[0].lights[0].rate());
  for (const ConfidenceRecord& record : records) {
    ASSERT_TRUE(record.interval) << record.reason;
    EXPECT_TRUE(record.interval->holds(record.rate));
    EXPECT_EQ(record.reason, "");
    EXPECT_EQ(record.blocks, 144U);
    EXPECT_EQ(record.blockSide, 12);
  }
  const compare::Interval alone =
      *compare::rateConfidence(errors.methods[0].lights[1], errors.tiling).interval;
  EXPECT_EQ(records[2].interval->low, alone.low);
  EXPECT_EQ(records[2].interval->high, alone.high);
}

TEST(ConfidenceOf, OneLightIsAllOfThem) {
  ViewErrors errors = someErrors();
  errors.lights = {"noon"};
  for (MethodErrors& method : errors.methods) method.lights.pop_back();
  const std::vector<ConfidenceRecord> records = confidenceOf(errors);
  ASSERT_EQ(records.size(), 3U);
  for (const ConfidenceRecord& record : records) EXPECT_EQ(record.light, "all");
}

TEST(DifferencesOf, ComparesEachMethodWithEveryLaterOne) {
  const ViewErrors errors = someErrors();
  const std::vector<ConfidenceRecord> rates = confidenceOf(errors);
  const std::vector<DifferenceRecord> records = differencesOf(errors, {0.0005, 0.0015});
  ASSERT_EQ(records.size(), 9U) << "all lights, then each";
  EXPECT_EQ(records[0].first, "rough");
  EXPECT_EQ(records[0].second, "fine");
  EXPECT_EQ(records[1].second, "close");
  EXPECT_EQ(records[2].first, "fine");
  EXPECT_EQ(records[2].second, "close");
  EXPECT_DOUBLE_EQ(records[0].difference, rates[0].rate - rates[3].rate);
  EXPECT_EQ(records[0].verdict, DifferenceVerdict::worse);
  EXPECT_EQ(records[2].verdict, DifferenceVerdict::notDistinguishable);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const DifferenceRecord& record = records[i];
    EXPECT_EQ(record.view, "camera");
    EXPECT_EQ(record.light, i < 3 ? "all" : i < 6 ? "noon" : "evening");
    EXPECT_DOUBLE_EQ(record.uncertainty, i < 3 ? 0.001 : i < 6 ? 0.0005 : 0.0015);
    ASSERT_TRUE(record.interval) << record.reason;
    EXPECT_TRUE(record.interval->holds(record.difference));
    EXPECT_EQ(record.verdict, distinguish(estimateOf(record)));
  }
  EXPECT_DOUBLE_EQ(records[0].difference, (records[3].difference + records[6].difference) / 2);
  compare::BlockErrors first = errors.methods[0].lights[0];
  compare::BlockErrors second = errors.methods[1].lights[0];
  first += errors.methods[0].lights[1];
  second += errors.methods[1].lights[1];
  EXPECT_EQ(records[0].interval->low,
            compare::differenceConfidence(first, second, errors.tiling).interval->low);
}

TEST(DifferencesOf, OneLightIsAllOfThem) {
  ViewErrors errors = someErrors();
  errors.lights = {"noon"};
  for (MethodErrors& method : errors.methods) method.lights.pop_back();
  const std::vector<DifferenceRecord> records = differencesOf(errors, {0.001});
  ASSERT_EQ(records.size(), 3U);
  for (const DifferenceRecord& record : records) EXPECT_EQ(record.light, "all");
}

/// Three variants that answer alike are equal to each other, and differ alike from any other.
TEST(DifferencesOf, TellsEqualAnswersAsSuch) {
  ViewErrors errors = someErrors();
  errors.methods[2].lights = errors.methods[1].lights;
  for (const DifferenceRecord& record : differencesOf(errors, {0, 0})) {
    const bool isPair = record.first == "fine";
    EXPECT_EQ(record.verdict, isPair ? DifferenceVerdict::equal : DifferenceVerdict::worse);
    EXPECT_EQ(record.interval.has_value(), !isPair);
    EXPECT_EQ(record.reason, isPair ? "both give the same answers" : "");
  }
  // Under one of the lights they answer differently.
  errors.methods[2].lights[0] = someErrors().methods[2].lights[0];
  const std::vector<DifferenceRecord> records = differencesOf(errors, {0, 0});
  EXPECT_NE(records[2].verdict, DifferenceVerdict::equal) << records[2].light;
  EXPECT_EQ(records[8].light, "evening");
  EXPECT_EQ(records[8].verdict, DifferenceVerdict::equal);
}

TEST(DifferencesOf, WithinTheTruthsUncertaintySaysNothing) {
  const std::vector<DifferenceRecord> sure = differencesOf(someErrors(), {0.1, 0.1});
  EXPECT_EQ(sure[0].verdict, DifferenceVerdict::worse);
  const std::vector<DifferenceRecord> unsure = differencesOf(someErrors(), {0.3, 0.3});
  EXPECT_EQ(unsure[0].verdict, DifferenceVerdict::notDistinguishable);
  EXPECT_EQ(unsure[0].difference, sure[0].difference);
}

}  // namespace
}  // namespace gnomon::study
