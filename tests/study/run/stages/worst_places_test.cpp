#include "study/run/stages/worst_places.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "study/run/no_files.h"

namespace gnomon::study {
namespace {

using testing::Each;

constexpr int width = 200, height = 100;

/// Embeds a picture as its bytes.
class Bytes : public NoFiles {
 public:
  [[nodiscard]] std::string embedded(int, int, const std::vector<std::uint8_t>& rgb,
                                     EmbeddedSize size) const override {
    EXPECT_EQ(size, EmbeddedSize::full);
    return {rgb.begin(), rgb.end()};
  }
};

Visibility filled(float share) {
  return {width, height, std::vector<float>(std::size_t{width} * height, share)};
}

std::size_t placeOf(int x, int y) {
  return static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
}

/// A colour that tells the sample.
std::array<std::uint8_t, 3> columnAndRow(std::size_t i) {
  return {static_cast<std::uint8_t>(i % width), static_cast<std::uint8_t>(i / width), 0};
}

std::array<std::uint8_t, 3> white(std::size_t) {
  return {255, 255, 255};
}

TEST(WorstPlaces, ShowBothPicturesWhereTheErrorIs) {
  const Visibility truth = filled(1);
  Visibility answer = truth;
  answer.shares[placeOf(199, 99)] = 0;
  answer.shares[placeOf(198, 99)] = 0.5F;
  const auto places = worstPlaces(answer, truth, columnAndRow, white, Bytes());
  ASSERT_EQ(places.size(), 1U);
  const WorstPlace& place = places[0];
  EXPECT_EQ(place.left, width - worstPlaceSide);
  EXPECT_EQ(place.top, height - worstPlaceSide);
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
  EXPECT_TRUE(worstPlaces(truth, truth, white, white, Bytes()).empty());
  Visibility answer = truth;
  truth.shares[7] = answer.shares[7] = noSample;
  EXPECT_TRUE(worstPlaces(answer, truth, white, white, Bytes()).empty());
}

TEST(WorstPlaces, AreThreeAtMost) {
  EXPECT_EQ(worstPlaces(filled(0), filled(1), white, white, Bytes()).size(), mostWorstPlaces);
}

}  // namespace
}  // namespace gnomon::study
