#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "image/grey_picture.h"
#include "image/images.h"
#include "image/mask_picture.h"
#include "support/error_messages.h"
#include "support/image_files.h"
#include "support/temporary_folder.h"

namespace gnomon::image {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;

constexpr Shade isLit = Shade::lit;
constexpr Shade isDark = Shade::shadowed;
constexpr Shade isNone = Shade::none;
constexpr float middleGrey = 128.0F / 255.0F;

class MaskPictures : public TemporaryFolder {
 protected:
  /// Of a picture of 3 × 2 pixels.
  [[nodiscard]] std::vector<Shade> shadesOf(const std::string& name,
                                            const MaskReading& reading = {}) const {
    const MaskPicture picture = readMaskPicture(file(name), reading);
    EXPECT_EQ(picture.mask.width, 3);
    EXPECT_EQ(picture.mask.height, 2);
    return picture.mask.samples;
  }
  [[nodiscard]] std::string refusal(const std::string& name,
                                    const MaskReading& reading = {}) const {
    std::string message = messageOf<InputError>([&] { readMaskPicture(file(name), reading); });
    EXPECT_THAT(message, HasSubstr(name));
    return message;
  }
  const std::vector<float> values_ = {1, 0, middleGrey, 0, 1, 1};
  const std::vector<Shade> shades_ = {isLit, isDark, isNone, isDark, isLit, isLit};
};

TEST_F(MaskPictures, GivesBackWhatGnomonWrites) {
  writePng(file("own.png"), maskImage({3, 2, shades_}));
  EXPECT_THAT(shadesOf("own.png"), ElementsAreArray(shades_));
  // In a mask of three values a threshold has nothing to decide.
  EXPECT_THAT(shadesOf("own.png", {{}, 0.7}), ElementsAreArray(shades_));
  EXPECT_EQ(readMaskPicture(file("own.png"), {{}, 0.7}).binarised, 0U);
}

TEST_F(MaskPictures, ReadsEveryFormatThatHoldsTheValues) {
  using OIIO::TypeDesc;
  const std::vector<std::pair<const char*, TypeDesc>> files = {
      {"byte.png", TypeDesc::UINT8}, {"word.png", TypeDesc::UINT16}, {"byte.tif", TypeDesc::UINT8},
      {"half.exr", TypeDesc::HALF},  {"float.exr", TypeDesc::FLOAT}, {"float.tif", TypeDesc::FLOAT},
      {"byte.bmp", TypeDesc::UINT8}};
  for (const auto& [name, type] : files) {
    test::writePicture(file(name), {3, 2, {"Y"}, values_, type});
    EXPECT_THAT(shadesOf(name), ElementsAreArray(shades_)) << name;
  }
  // Integers of 32 bits are flags: 1 is lit, not a share of their largest value.
  const auto out = OIIO::ImageOutput::create(file("flags.exr").string());
  const OIIO::ImageSpec spec(3, 2, 1, TypeDesc::UINT32);
  ASSERT_TRUE(out->open(file("flags.exr").string(), spec));
  const std::vector<std::uint32_t> flags = {1, 0, 0, 0, 1, 1};
  ASSERT_TRUE(out->write_image(TypeDesc::UINT32, flags.data()));
  ASSERT_TRUE(out->close());
  EXPECT_THAT(shadesOf("flags.exr"), ElementsAre(isLit, isDark, isDark, isDark, isLit, isLit));
}

TEST_F(MaskPictures, ThreeEqualChannelsAreOneAndOthersMustBeNamed) {
  std::vector<float> equal, different;
  for (const float value : values_) {
    equal.insert(equal.end(), {value, value, value});
    different.insert(different.end(), {0.25F, value, value});
  }
  test::writePicture(file("rgb.exr"), {3, 2, {"R", "G", "B"}, equal});
  EXPECT_THAT(shadesOf("rgb.exr"), ElementsAreArray(shades_));
  test::writePicture(file("tint.exr"), {3, 2, {"R", "G", "B"}, different});
  EXPECT_THAT(refusal("tint.exr"),
              AllOf(HasSubstr("channels differ, 0.25 and 1 at column 0, row 0")));
  EXPECT_THAT(shadesOf("tint.exr", {"G", {}}), ElementsAreArray(shades_));
  EXPECT_THAT(refusal("tint.exr", {"shadow", {}}),
              HasSubstr("no channel \"shadow\", it has R, G, B"));
  test::writePicture(file("two.exr"), {3, 1, {"diffuse", "shadow"}, {9, 1, 9, 0, 9, 1}});
  EXPECT_THAT(refusal("two.exr"), HasSubstr("channels diffuse, shadow found"));
  EXPECT_THAT(readMaskPicture(file("two.exr"), {"shadow", {}}).mask.samples,
              ElementsAre(isLit, isDark, isLit));
}

TEST_F(MaskPictures, FindsAChannelInALaterPart) {
  std::vector<OIIO::ImageSpec> parts(2, OIIO::ImageSpec(3, 1, 1, OIIO::TypeDesc::HALF));
  parts[0].channelnames = {"depth"};
  parts[1].channelnames = {"shadow"};
  const auto out = OIIO::ImageOutput::create(file("parts.exr").string());
  ASSERT_TRUE(out->open(file("parts.exr").string(), 2, parts.data()));
  const std::vector<float> depth = {5, 6, 7}, shadow = {0, 1, 0};
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, depth.data()));
  ASSERT_TRUE(out->open(file("parts.exr").string(), parts[1], OIIO::ImageOutput::AppendSubimage));
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, shadow.data()));
  ASSERT_TRUE(out->close());
  EXPECT_THAT(readMaskPicture(file("parts.exr"), {"shadow", {}}).mask.samples,
              ElementsAre(isDark, isLit, isDark));
}

TEST_F(MaskPictures, NoCoverMeansNoSample) {
  const std::vector<float> pixels = {1, 1, 0, 1, 0, 0, 1, 0, 0, 1, 1, 1};
  test::writePicture(file("cover.exr"), {3, 2, {"Y", "A"}, pixels});
  EXPECT_THAT(shadesOf("cover.exr"), ElementsAre(isLit, isDark, isNone, isNone, isDark, isLit));
  test::writePicture(file("cover.png"), {3, 2, {"Y", "A"}, pixels, OIIO::TypeDesc::UINT8});
  EXPECT_THAT(shadesOf("cover.png"), ElementsAre(isLit, isDark, isNone, isNone, isDark, isLit));
}

TEST_F(MaskPictures, PartialCoverNeedsAThresholdAndIsDividedOut) {
  // White of 0.6 cover, held multiplied; 0.3 cover; 0.6 cover of a third.
  test::writePicture(file("soft.exr"), {3, 1, {"Y", "A"}, {0.6F, 0.6F, 0.3F, 0.3F, 0.2F, 0.6F}});
  EXPECT_THAT(refusal("soft.exr"), AllOf(HasSubstr("3 of 3 pixels are neither"),
                                         HasSubstr("with alpha 0.6"), HasSubstr("--binarise")));
  const MaskPicture picture = readMaskPicture(file("soft.exr"), {{}, 0.5});
  EXPECT_THAT(picture.mask.samples, ElementsAre(isLit, isNone, isDark));
  EXPECT_EQ(picture.binarised, 3U);
  // PNG holds colours beside alpha, unmultiplied.
  OIIO::ImageSpec spec(3, 1, 2, OIIO::TypeDesc::UINT8);
  spec.alpha_channel = 1;
  spec.attribute("oiio:UnassociatedAlpha", 1);
  test::writePicture(file("soft.png"), spec, {1, 0.6F, 1, 0.3F, 0.4F, 0.6F});
  EXPECT_THAT(readMaskPicture(file("soft.png"), {{}, 0.5}).mask.samples,
              ElementsAre(isLit, isNone, isDark));
}

TEST_F(MaskPictures, AThresholdPartsEveryValueOfASoftMask) {
  test::writePicture(file("soft.exr"), {3, 2, {"Y"}, {0.9F, 0.1F, middleGrey, 0.5F, 0, 1.2F}});
  EXPECT_THAT(refusal("soft.exr"), AllOf(HasSubstr("4 of 6 pixels are neither black, white"),
                                         HasSubstr("first 0.9 at column 0, row 0")));
  const MaskPicture picture = readMaskPicture(file("soft.exr"), {{}, 0.5});
  // The grey is a value like others here, since the picture is no mask of three values.
  EXPECT_THAT(picture.mask.samples, ElementsAre(isLit, isDark, isLit, isLit, isDark, isLit));
  EXPECT_EQ(picture.binarised, 4U);
  EXPECT_THAT(shadesOf("soft.exr", {{}, 0.51}),
              ElementsAre(isLit, isDark, isDark, isDark, isDark, isLit));
}

TEST_F(MaskPictures, GreyIsGnomonsAndNoOther) {
  for (const int value : {127, 129}) {
    test::writePicture(file("near.png"),
                       {1, 1, {"Y"}, {static_cast<float>(value) / 255}, OIIO::TypeDesc::UINT8});
    EXPECT_THAT(refusal("near.png"), HasSubstr("1 of 1 pixels"));
  }
}

TEST_F(MaskPictures, InvertsAndTurns) {
  test::writePicture(file("m.exr"), {3, 2, {"Y"}, values_});
  EXPECT_THAT(shadesOf("m.exr", {{}, {}, true}),
              ElementsAre(isDark, isLit, isNone, isLit, isDark, isDark));
  EXPECT_THAT(shadesOf("m.exr", {{}, {}, false, true}),
              ElementsAre(isDark, isLit, isLit, isLit, isDark, isNone));
}

TEST_F(MaskPictures, ThePictureIsTheDisplayWindow) {
  // Data over (1, 1) to (4, 3) of a display of 3 × 2 at the origin: one row and two columns show.
  OIIO::ImageSpec spec(4, 3, 1, OIIO::TypeDesc::HALF);
  spec.x = spec.y = 1;
  spec.full_x = spec.full_y = 0;
  spec.full_width = 3;
  spec.full_height = 2;
  test::writePicture(file("window.exr"), spec, {1, 0, 1, 0, 1, 1, 1, 1, 0, 0, 0, 0});
  EXPECT_THAT(shadesOf("window.exr"), ElementsAre(isNone, isNone, isNone, isNone, isLit, isDark));
  // The display begins within the data.
  spec.x = spec.y = -1;
  test::writePicture(file("overscan.exr"), spec, {0, 0, 0, 0, 0, 1, 0, 1, 0, 1, 1, 0});
  EXPECT_THAT(shadesOf("overscan.exr"), ElementsAre(isLit, isDark, isLit, isLit, isLit, isDark));
}

TEST_F(MaskPictures, RefusesWhatIsNotFiniteThresholdOrNot) {
  for (const float value : {std::nanf(""), std::numeric_limits<float>::infinity()}) {
    test::writePicture(file("nan.exr"), {3, 1, {"Y"}, {1, value, value}});
    for (const std::optional<double> threshold : {std::optional<double>(), std::optional(0.5)}) {
      EXPECT_THAT(refusal("nan.exr", {{}, threshold}),
                  AllOf(HasSubstr("2 of 3 pixels are not finite"), HasSubstr("column 1, row 0")));
    }
  }
  const float nan = std::nanf("");
  test::writePicture(file("rgb.exr"), {1, 1, {"R", "G", "B"}, {nan, nan, nan}});
  EXPECT_THAT(refusal("rgb.exr"), HasSubstr("not finite"));
}

TEST_F(MaskPictures, RefusesWhatIsNoUprightPicture) {
  EXPECT_THAT(refusal("missing.png"), HasSubstr("no such file"));
  std::filesystem::create_directory(file("folder.png"));
  EXPECT_THAT(refusal("folder.png"), HasSubstr("no such file"));
  writeTextAtomically(file("text.png"), "not a picture");
  EXPECT_THAT(refusal("text.png"), HasSubstr("not an image that can be read"));
  OIIO::ImageSpec turned(3, 2, 1, OIIO::TypeDesc::UINT8);
  turned.attribute("Orientation", 6);
  test::writePicture(file("turned.tif"), turned, {1, 0, 1, 0, 1, 1});
  EXPECT_THAT(refusal("turned.tif"), HasSubstr("Orientation is 6"));
  test::writePicture(file("whole.exr"), {64, 64, {"Y"}, std::vector<float>(64 * 64, 1)});
  const std::string bytes = readFile(file("whole.exr"));
  writeTextAtomically(file("cut.exr"), bytes.substr(0, bytes.size() / 2));
  EXPECT_THAT(refusal("cut.exr"), HasSubstr("cut.exr"));
}

TEST_F(MaskPictures, DamageIsRefusedOrHarmless) {
  std::vector<float> pixels;
  for (int i = 0; i < 11 * 6; ++i) pixels.push_back(i % 3 == 0 ? 1.0F : 0.0F);
  for (const char* name : {"m.exr", "m.tif", "m.bmp"}) {
    test::writePicture(
        file(name),
        {11, 6, {"Y"}, pixels, name[2] == 'e' ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::UINT8});
    const std::string whole = readFile(file(name));
    const std::string bad = std::string("bad") + &name[1];
    std::mt19937 random(4);
    for (int i = 0; i < 100; ++i) {
      std::string damaged = whole;
      damaged[random() % damaged.size()] = static_cast<char>(random());
      writeTextAtomically(file(bad), damaged);
      try {
        const MaskPicture picture = readMaskPicture(file(bad), {{}, 0.5});
        EXPECT_EQ(picture.mask.size(), static_cast<std::size_t>(picture.mask.width) *
                                           static_cast<std::size_t>(picture.mask.height));
      } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      } catch (const MemoryError&) {
      }
    }
  }
}

class SharePicture : public TemporaryFolder {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& bytes) {
    std::ofstream(file(name), std::ios::binary) << bytes;
    return file(name);
  }
};

Visibility everyLevel() {
  Visibility map{16, 17, {}};
  for (int k = 0; k <= 256; ++k) map.shares.push_back(static_cast<float>(k) / 256);
  map.shares.push_back(noSample);
  map.shares.push_back(128.0F / 255.0F);  // the grey itself
  while (map.shares.size() < 16 * 17) map.shares.push_back(1);
  return map;
}

TEST_F(SharePicture, ComesBackFromSixteenBitsToHalfAStep) {
  const Visibility map = everyLevel();
  const Visibility back = readSharePicture(write("map.png", sharePng(map)));
  ASSERT_EQ(back.size(), map.size());
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (std::isnan(map.shares[i])) {
      EXPECT_TRUE(std::isnan(back.shares[i]));
    } else {
      EXPECT_NEAR(back.shares[i], map.shares[i], i == 258 ? 2e-5 : 8e-6) << i;
    }
  }
  EXPECT_EQ(sharePng(map), sharePng(map));
}

TEST_F(SharePicture, ComesBackFromFloatsAsItIs) {
  const Visibility map = everyLevel();
  const Visibility back = readSharePicture(write("map.exr", shareExr(map)));
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (i == 258) continue;
    EXPECT_TRUE(back.shares[i] == map.shares[i] || std::isnan(map.shares[i])) << i;
  }
  EXPECT_TRUE(std::isnan(back.shares[257]));
  EXPECT_NEAR(back.shares[258], map.shares[258], 3e-5);
}

// Every pair of shares in steps of a sixteenth.
TEST_F(SharePicture, ComesBackFromASignedDifferenceAsFarAsItsColoursHoldIt) {
  Visibility candidate{17, 18, {}};
  Visibility truth{17, 18, {}};
  for (int k = 0; k < 17 * 17; ++k) {
    candidate.shares.push_back(static_cast<float>(k % 17) / 16);
    truth.shares.push_back(static_cast<float>(k / 17) / 16);
  }
  candidate.shares.resize(17 * 18, noSample);
  truth.shares.resize(17 * 18, noSample);
  const Visibility back =
      sharesOfDifference(write("d.png", pngOf(shareDifferenceImage(candidate, truth))));
  ASSERT_EQ(back.size(), candidate.size());
  for (std::size_t i = 0; i < 17 * 17; ++i) {
    const float share = candidate.shares[i];
    const float off = std::abs(share - truth.shares[i]);
    const bool isMask = off == 1 || (off == 0 && (share == 0 || share == 1));
    EXPECT_NEAR(back.shares[i], share, isMask ? 0 : off <= 0.5F ? 0.02 : 0.1) << i;
  }
  for (std::size_t i = 17 * 17; i < back.size(); ++i) EXPECT_TRUE(std::isnan(back.shares[i]));
}

TEST_F(SharePicture, RefusesColoursThatNoSignedDifferenceHas) {
  for (const Rgb& colour :
       {Rgb{0, 255, 0}, Rgb{10, 10, 10}, Rgb{255, 0, 255}, Rgb{240, 240, 240}}) {
    const Image image{1, 1, {colour.begin(), colour.end()}};
    EXPECT_THAT(
        messageOf<InputError>([&] { (void)sharesOfDifference(write("d.png", pngOf(image))); }),
        HasSubstr("d.png: a colour found that no signed difference has"));
  }
}

TEST_F(SharePicture, IsReadUpsideDownAndInverted) {
  const Visibility map{1, 2, {0.25F, noSample}};
  const auto path = write("map.exr", shareExr(map));
  const Visibility back = readSharePicture(path, {{}, {}, true, true});
  EXPECT_TRUE(std::isnan(back.shares[0]));
  EXPECT_FLOAT_EQ(back.shares[1], 0.75F);
}

TEST_F(SharePicture, OfAMaskIsZerosAndOnes) {
  const Mask mask{3, 1, {Shade::lit, Shade::shadowed, Shade::none}};
  const auto path = write("mask.png", pngOf(maskImage(mask)));
  const Visibility back = readSharePicture(path);
  EXPECT_TRUE(isSame(back, {3, 1, {1, 0, noSample}}));
  EXPECT_FALSE(holdsShares(path));
  EXPECT_TRUE(holdsShares(write("map.png", sharePng({2, 1, {0.5F, 1}}))));
  EXPECT_FALSE(holdsShares(write("hard.png", sharePng({2, 1, {0, 1}}))));
  EXPECT_FALSE(holdsShares(write("grey.png", sharePng({2, 1, {noSample, 1}}))));
}

TEST_F(SharePicture, IsCutByAThresholdWithoutItsBackground) {
  const auto path = write("map.png", sharePng({4, 1, {0.25F, 0.5F, 0.75F, noSample}}));
  const Mask cut = readMaskPicture(path, {.channel = {}, .threshold = 0.5}).mask;
  EXPECT_EQ(cut.samples, cutInHalf(readSharePicture(path)).samples);
  EXPECT_EQ(cut.samples[3], Shade::none);
}

TEST_F(SharePicture, RefusesWhatIsNoShare) {
  Visibility map{2, 1, {0.5F, 1.5F}};
  const auto path = write("map.exr", shareExr(map));
  EXPECT_THAT(messageOf<InputError>([&] { (void)readSharePicture(path); }),
              HasSubstr("column 1, row 0"));
}

TEST(ShareDifference, OfZerosAndOnesIsTheMasks) {
  const Mask candidate{
      5, 1, {Shade::lit, Shade::shadowed, Shade::lit, Shade::shadowed, Shade::none}};
  const Mask truth{5, 1, {Shade::lit, Shade::lit, Shade::shadowed, Shade::shadowed, Shade::none}};
  EXPECT_EQ(shareDifferenceImage(asShares(candidate), asShares(truth)).rgb,
            unfolded(differenceImage(candidate, truth)).rgb);
}

TEST(ShareDifference, GrowsWithTheError) {
  const Visibility truth{3, 1, {0.5F, 0.5F, 0.5F}};
  const Image image = shareDifferenceImage({3, 1, {0.5F, 0.25F, 0}}, truth);
  const auto red = [&](std::size_t i) { return image.rgb[3 * i]; };
  EXPECT_EQ(image.rgb[0], image.rgb[2]) << "agreement is grey";
  EXPECT_LT(red(0), red(1));
  EXPECT_LT(red(1), red(2));
  EXPECT_THROW((void)shareDifferenceImage({3, 1, {noSample, 0, 0}}, truth), InputError);
}

}  // namespace
}  // namespace gnomon::image
