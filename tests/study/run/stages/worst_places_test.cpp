#include "study/run/stages/worst_places.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "study/run/no_files.h"

namespace gnomon::study {
namespace {

using testing::Each;

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

}  // namespace
}  // namespace gnomon::study
