#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <random>
#include <vector>

#include "common/error.h"
#include "relief/height_field.h"
#include "relief/relief.h"
#include "support/error_messages.h"
#include "support/temporary_folder.h"
#include "surface/cage/shapes.h"

namespace gnomon::relief {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

surface::TexelFrame frameWith(const Vec3& px, const Vec3& py) {
  return {{1, 2, 3}, glm::normalize(glm::cross(px, py)), px, py, {1.5, 0.5}, true};
}

HeightField twoTexels() {
  return {2, 1, {0, 4}, Wrap::clamp};
}

TEST(Relief, AHeightInWorldUnitsIsALength) {
  const surface::TexelFrame frame = frameWith({0.1, 0, 0}, {0, 0.3, 0});
  EXPECT_EQ(worldPerHeight(HeightSpace::world, frame), 1);
  const Relief relief{twoTexels(), HeightSpace::world, {1, 1}};
  EXPECT_EQ(displaced(relief, frame), Vec3(1, 2, 7));
}

TEST(Relief, AHeightInTexelsScalesWithTheRootOfATexelsArea) {
  // A texel of 4 by 9 world units has area 36, sheared or not: one height unit is 6.
  for (const double shear : {0.0, 5.0}) {
    const surface::TexelFrame frame = frameWith({4, 0, 0}, {shear, 9, 0});
    EXPECT_DOUBLE_EQ(worldPerHeight(HeightSpace::texture, frame), 6);
    const Relief relief{twoTexels(), HeightSpace::texture, {1, 1}};
    EXPECT_DOUBLE_EQ(displaced(relief, frame).z, 3 + 6 * 4);
  }
}

TEST(Relief, ScalingTheSurfaceScalesTextureHeights) {
  const surface::TexelFrame one = frameWith({1, 0.2, 0}, {0, 1, 0.5});
  const surface::TexelFrame ten = frameWith({10, 2, 0}, {0, 10, 5});
  EXPECT_DOUBLE_EQ(worldPerHeight(HeightSpace::texture, ten),
                   10 * worldPerHeight(HeightSpace::texture, one));
}

TEST(Relief, AnUndefinedFrameIsNotDisplaced) {
  surface::TexelFrame frame{};
  frame.position = {1, 2, 3};
  frame.texel = {std::nan(""), 0};
  for (const HeightSpace space : {HeightSpace::world, HeightSpace::texture}) {
    EXPECT_EQ(displaced({twoTexels(), space, {1, 1}}, frame), Vec3(1, 2, 3));
  }
}

TEST(Relief, RepeatsMultiplyTheTexels) {
  const Relief relief{twoTexels(), HeightSpace::world, {3, 5}};
  EXPECT_EQ(relief.texelsPerUv(), Vec2(6, 5));
}

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

class HeightImage : public TemporaryFolder {
 protected:
  /// Writes 3 × 2 pixels, the top row first.
  template <typename Value>
  std::filesystem::path write(const std::string& name, OIIO::TypeDesc type, int channels,
                              const std::vector<Value>& values) {
    const auto path = file(name);
    const auto image = OIIO::ImageOutput::create(path.string());
    OIIO::ImageSpec spec(3, 2, channels, type);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    EXPECT_TRUE(image->open(path.string(), spec));
    EXPECT_TRUE(image->write_image(type, values.data()));
    EXPECT_TRUE(image->close());
    return path;
  }
};

TEST_F(HeightImage, TheLastRowOfTheImageIsRowZero) {
  const auto path =
      write<std::uint8_t>("a.png", OIIO::TypeDesc::UINT8, 1, {0, 51, 102, 153, 204, 255});
  const HeightField field = readHeightImage(path, 0, 10, Wrap::repeat);
  ASSERT_EQ(field.width(), 3);
  ASSERT_EQ(field.height(), 2);
  const std::vector<float> expected = {6, 8, 10, 0, 2, 4};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_FLOAT_EQ(field.texels()[i], expected[i]);
  EXPECT_EQ(field.wrap(), Wrap::repeat);
}

TEST_F(HeightImage, SixteenBitsAreNormalisedToo) {
  const auto path =
      write<std::uint16_t>("a.png", OIIO::TypeDesc::UINT16, 1, {0, 1, 2, 3, 4, 65535});
  const HeightField field = readHeightImage(path, 0, 65535, Wrap::clamp);
  const std::vector<float> expected = {3, 4, 65535, 0, 1, 2};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_FLOAT_EQ(field.texels()[i], expected[i]);
}

TEST_F(HeightImage, FloatsAreTakenAsTheyAre) {
  const std::vector<float> heights = {-3, 1e-20F, 1000.1F, 7, 8, 0.1F};
  for (const std::string name : {"a.exr", "a.tif"}) {
    const auto path = write<float>(name, OIIO::TypeDesc::FLOAT, 1, heights);
    const HeightField field = readHeightImage(path, 0, 1, Wrap::clamp);
    EXPECT_EQ(field.texels(), (std::vector<float>{7, 8, 0.1F, -3, 1e-20F, 1000.1F})) << name;
  }
}

TEST_F(HeightImage, ReadsTheChannelAskedForWhateverTheAlpha) {
  std::vector<std::uint8_t> pixels;
  for (std::uint8_t i = 0; i < 6; ++i) {
    for (const int value : {51, 102, 153, 20 * i})
      pixels.push_back(static_cast<std::uint8_t>(value));
  }
  const auto path = write("a.png", OIIO::TypeDesc::UINT8, 4, pixels);
  EXPECT_FLOAT_EQ(readHeightImage(path, 1, 5, Wrap::clamp).texel(0, 0), 2);
  EXPECT_FLOAT_EQ(readHeightImage(path, 1, 5, Wrap::clamp).texel(0, 1), 2) << "alpha 0";
  EXPECT_FLOAT_EQ(readHeightImage(path, 3, 255, Wrap::clamp).texel(2, 0), 100);
  for (const int channel : {-1, 4}) {
    EXPECT_THAT(messageOf<InputError>([&] { readHeightImage(path, channel, 1, Wrap::clamp); }),
                AllOf(HasSubstr("a.png"), HasSubstr("0 to 3")));
  }
}

TEST_F(HeightImage, RefusesHeightsThatAreNotFinite) {
  for (const float bad : {NAN, INFINITY, -INFINITY}) {
    const auto path = write<float>("a.exr", OIIO::TypeDesc::FLOAT, 1, {0, 0, 0, 0, bad, 0});
    EXPECT_THAT(messageOf<InputError>([&] { readHeightImage(path, 0, 1, Wrap::clamp); }),
                AllOf(HasSubstr("a.exr"), HasSubstr("pixel (1, 1)")));
  }
  const auto path = write<float>("b.exr", OIIO::TypeDesc::FLOAT, 1, {0, 0, 1e30F, 0, 0, 0});
  EXPECT_THAT(messageOf<InputError>([&] { readHeightImage(path, 0, 1e30, Wrap::clamp); }),
              HasSubstr("pixel (2, 0)"));
}

TEST_F(HeightImage, RefusesWhatIsNoImage) {
  EXPECT_THAT(messageOf<InputError>([&] { readHeightImage(file("none.png"), 0, 1, Wrap::clamp); }),
              AllOf(HasSubstr("none.png"), HasSubstr("no such file")));
  EXPECT_THROW(readHeightImage(folder(), 0, 1, Wrap::clamp), InputError);
  std::ofstream(file("empty.png")).close();
  EXPECT_THROW(readHeightImage(file("empty.png"), 0, 1, Wrap::clamp), InputError);
  std::ofstream(file("text.exr")) << "no image at all";
  EXPECT_THAT(messageOf<InputError>([&] { readHeightImage(file("text.exr"), 0, 1, Wrap::clamp); }),
              HasSubstr("text.exr"));
}

TEST_F(HeightImage, RefusesATruncatedImage) {
  const auto path = write<float>("a.exr", OIIO::TypeDesc::FLOAT, 1, {1, 2, 3, 4, 5, 6});
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 10);
  EXPECT_THAT(messageOf<InputError>([&] { readHeightImage(path, 0, 1, Wrap::clamp); }),
              HasSubstr("a.exr"));
}

/// As from a file, which tells no grid.
surface::Cage quad() {
  surface::Cage cage;
  cage.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  cage.faceVertices = {0, 1, 2, 3};
  cage.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  cage.faceUvs = {0, 1, 2, 3};
  return cage;
}

TEST(DefaultWrap, ClampsOpenMeshesThatTheMapIsLaidOverOnce) {
  EXPECT_EQ(defaultWrap(quad(), Vec2(1)), Wrap::clamp);
  EXPECT_EQ(defaultWrap(quad(), Vec2(2, 1)), Wrap::repeat) << "laid twice";
  EXPECT_EQ(defaultWrap(surface::makePlane(8, 8, 4, 4), Vec2(1)), Wrap::repeat)
      << "a shape knows its border";
  surface::Cage torus = surface::makeTorus(30, 10, 66, 58);
  torus.grid.reset();
  EXPECT_EQ(defaultWrap(torus, Vec2(1)), Wrap::repeat) << "closed";
  surface::Cage twoSided = quad();
  twoSided.faceVertices.insert(twoSided.faceVertices.end(), {3, 2, 1, 0});
  twoSided.faceUvs.insert(twoSided.faceUvs.end(), {3, 2, 1, 0});
  EXPECT_EQ(defaultWrap(twoSided, Vec2(1)), Wrap::repeat) << "closed, of two faces";
}

/// Heights between -1 and 1 that have nothing to do with each other: a kink on every centre line.
HeightField randomHeights(int width, int height, Wrap wrap) {
  std::mt19937 random(7);
  std::vector<float> texels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (float& h : texels) h = static_cast<float>(random()) * 0x1p-31F - 1;
  return {width, height, std::move(texels), wrap};
}

class ResampledHeights : public testing::TestWithParam<std::tuple<int, Wrap>> {};

TEST_P(ResampledHeights, AreTheSameFunctionEverywhere) {
  const auto [factor, wrap] = GetParam();
  const HeightField coarse = randomHeights(11, 7, wrap);
  const HeightField fine = resampledHeights(coarse, factor, 1);
  EXPECT_EQ(fine.width(), 11 * factor);
  EXPECT_EQ(fine.height(), 7 * factor);
  EXPECT_EQ(fine.wrap(), wrap);
  std::mt19937 random(3);
  // Three maps around, so that the border is crossed on all sides.
  std::uniform_real_distribution<double> x(-11, 22);
  std::uniform_real_distribution<double> y(-7, 14);
  // A height is rounded once, by half of 2⁻²³ at 1; the function mixes four of them.
  const double rounding = 0x1p-24;
  for (int i = 0; i < 20000; ++i) {
    const Vec2 place(x(random), y(random));
    ASSERT_NEAR(fine.at(place * static_cast<double>(factor)), coarse.at(place), rounding)
        << place.x << " " << place.y;
  }
}

TEST_P(ResampledHeights, HoldTheOldTexelsToTheBit) {
  const auto [factor, wrap] = GetParam();
  const HeightField coarse = randomHeights(11, 7, wrap);
  const HeightField fine = resampledHeights(coarse, factor, 1);
  const int middle = (factor - 1) / 2;
  for (int j = 0; j < 7; ++j) {
    for (int i = 0; i < 11; ++i) {
      ASSERT_EQ(fine.texel(i * factor + middle, j * factor + middle), coarse.texel(i, j));
    }
  }
}

TEST_P(ResampledHeights, CountTexelsOnceMoreWhereHeightsDo) {
  const auto [factor, wrap] = GetParam();
  const HeightField coarse = randomHeights(5, 4, wrap);
  const HeightField once = resampledHeights(coarse, factor, 1);
  const HeightField scaled = resampledHeights(coarse, factor, factor);
  for (std::size_t i = 0; i < once.texels().size(); ++i) {
    ASSERT_NEAR(scaled.texels()[i], static_cast<float>(factor) * once.texels()[i],
                factor * 0x1p-23);
  }
}

INSTANTIATE_TEST_SUITE_P(Factors, ResampledHeights,
                         testing::Combine(testing::Values(1, 3, 5, 9),
                                          testing::Values(Wrap::repeat, Wrap::clamp)));

TEST(ResampledHeightsErrors, AnEvenFactorIsAnotherFunction) {
  EXPECT_THROW((void)resampledHeights(randomHeights(4, 4, Wrap::clamp), 2, 1), InternalError);
}

TEST(ResampledHeightsErrors, WhatDoesNotFitIsRefusedBeforeItIsAllocated) {
  const HeightField field = randomHeights(1024, 1024, Wrap::clamp);
  EXPECT_THAT(messageOf<MemoryError>([&] { (void)resampledHeights(field, 32767, 1); }),
              testing::StartsWith("factor: 32767, a map of 33553408 × 33553408 texels"));
}

}  // namespace
}  // namespace gnomon::relief
