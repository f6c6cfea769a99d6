#include "image/share_picture.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

#include "common/error.h"
#include "image/images.h"
#include "support/error_messages.h"
#include "support/temporary_folder.h"

namespace gnomon::image {
namespace {

using ::testing::HasSubstr;

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
