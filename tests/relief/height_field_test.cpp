#include "relief/height_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "common/error.h"
#include "support/error_messages.h"

namespace gnomon::relief {
namespace {
using ::testing::HasSubstr;

HeightField ramp(Wrap wrap) {
  std::vector<float> texels;
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 4; ++x) texels.push_back(static_cast<float>(x + 10 * y));
  }
  return {4, 3, texels, wrap};
}

HeightField randomField(int width, int height, Wrap wrap) {
  std::mt19937 random(5);
  std::vector<float> texels(static_cast<std::size_t>(width * height));
  for (float& h : texels) h = static_cast<float>(random()) * 0x1p-32F;
  return {width, height, texels, wrap};
}

TEST(HeightField, HoldsItsTexelsAtTheirCentres) {
  for (const Wrap wrap : {Wrap::repeat, Wrap::clamp}) {
    const HeightField field = ramp(wrap);
    for (int y = 0; y < 3; ++y) {
      for (int x = 0; x < 4; ++x) {
        EXPECT_EQ(field.at({x + 0.5, y + 0.5}), x + 10 * y);
        EXPECT_EQ(field.texel(x, y), static_cast<float>(x + 10 * y));
      }
    }
    EXPECT_EQ(field.minimum(), 0);
    EXPECT_EQ(field.maximum(), 23);
  }
}

TEST(HeightField, IsBilinearBetweenCentres) {
  // x + 10 y is its own bilinear interpolant.
  EXPECT_DOUBLE_EQ(ramp(Wrap::clamp).at({1.75, 2.125}), 1.25 + 16.25);
  // One with a twist: h = u v between four texels.
  const HeightField saddle(2, 2, {0, 0, 0, 1}, Wrap::clamp);
  EXPECT_DOUBLE_EQ(saddle.at({0.5 + 0.25, 0.5 + 0.5}), 0.125);
}

TEST(HeightField, RepeatsOrClampsOutside) {
  const HeightField repeated = ramp(Wrap::repeat);
  EXPECT_DOUBLE_EQ(repeated.at({4, 0.5}), 1.5) << "half way from the last texel to the first";
  EXPECT_DOUBLE_EQ(repeated.at({-0.25, 0.5}), repeated.at({3.75, 0.5}));
  EXPECT_EQ(repeated.texel(-1, -1), 23);
  EXPECT_EQ(repeated.texel(4, 3), 0);
  const HeightField clamped = ramp(Wrap::clamp);
  EXPECT_DOUBLE_EQ(clamped.at({17, 0.5}), 3);
  EXPECT_DOUBLE_EQ(clamped.at({-17, -3}), 0);
  EXPECT_EQ(clamped.texel(-9, 99), 20);
}

TEST(HeightField, RepeatsExactlyFarAway) {
  const HeightField field = randomField(8, 4, Wrap::repeat);
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i) {
    // Quarters of a texel keep the far positions exact.
    const Vec2 near(0.25 * static_cast<int>(random() % 32), 0.25 * static_cast<int>(random() % 16));
    // Up to 2^48 texels, where an int would have overflowed.
    const double away = 8.0 * 16384 * (static_cast<double>(random()) - 0x1p31);
    EXPECT_EQ(field.at(near + Vec2(away, -away)), field.at(near)) << away;
  }
}

TEST(HeightField, TakesAnyFinitePosition) {
  for (const Wrap wrap : {Wrap::repeat, Wrap::clamp}) {
    const HeightField field = randomField(7, 5, wrap);
    for (const double far : {1e9, -1e9, 1e18, -1e300, std::numeric_limits<double>::max(),
                             -std::numeric_limits<double>::denorm_min(), 0.5 - 1e-17}) {
      const double h = field.at({far, -far});
      EXPECT_GE(h, field.minimum());
      EXPECT_LE(h, field.maximum());
    }
    EXPECT_THROW(static_cast<void>(field.at({std::nan(""), 0})), InternalError);
    EXPECT_NO_THROW(static_cast<void>(
        field.texel(std::numeric_limits<int>::min(), std::numeric_limits<int>::max())));
  }
}

TEST(HeightField, InvertedTwiceIsItself) {
  const HeightField field(2, 2, {0, 1, 2, 4}, Wrap::clamp);
  const HeightField turned = inverted(field, 4);
  EXPECT_EQ(turned.texels(), (std::vector<float>{4, 3, 2, 0}));
  EXPECT_EQ(turned.wrap(), Wrap::clamp);
  EXPECT_EQ(inverted(turned, 4).texels(), field.texels());
}

TEST(HeightField, IsKnownUpToItsBorder) {
  const HeightField closed(8, 6, std::vector<float>(48), Wrap::clamp);
  EXPECT_TRUE(std::isinf(closed.knownLength({3, 3}, {1, 0})));
  const HeightField open = closed.withBorder({true, true});
  EXPECT_DOUBLE_EQ(open.knownLength({3, 2}, {1, 0}), 5);
  EXPECT_DOUBLE_EQ(open.knownLength({3, 2}, {-1, 0}), 3);
  EXPECT_DOUBLE_EQ(open.knownLength({3, 2}, {0, -1}), 2);
  EXPECT_DOUBLE_EQ(open.knownLength({3, 2}, glm::normalize(Vec2(1, 1))), 4 * std::sqrt(2.0));
  EXPECT_EQ(open.knownLength({30, 2}, {1, 0}), 0) << "past the border nothing is known";
  const HeightField strip = closed.withBorder({false, true});
  EXPECT_TRUE(std::isinf(strip.knownLength({3, 2}, {1, 0})));
  EXPECT_DOUBLE_EQ(strip.knownLength({3, 2}, {0.6, 0.8}), 4 / 0.8);
}

TEST(HeightField, RefusesWhatIsNoMap) {
  EXPECT_THAT(messageOf<InputError>([] { HeightField(0, 2, {}, Wrap::clamp); }),
              HasSubstr("0 x 2"));
  EXPECT_THAT(messageOf<InputError>([] { HeightField(-1, -1, {1}, Wrap::clamp); }),
              HasSubstr("-1 x -1"));
  EXPECT_THAT(messageOf<InputError>([] {
                HeightField(2, 2, {1, 2, 3}, Wrap::clamp);
              }),
              HasSubstr("4 expected"));
  EXPECT_THAT(messageOf<InputError>([] {
                HeightField(2, 2, {1, 2, 3, NAN}, Wrap::clamp);
              }),
              HasSubstr("(1, 1)"));
  EXPECT_THAT(messageOf<InputError>([] {
                HeightField(2, 2, {1, INFINITY, 3, 4}, Wrap::clamp);
              }),
              HasSubstr("(1, 0)"));
}

}  // namespace
}  // namespace gnomon::relief
