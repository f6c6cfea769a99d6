#include "report/web_picture.h"

#include <gmock/gmock.h>

#include <cmath>

#include "common/atomic_file.h"
#include "common/error.h"
#include "report/images.h"
#include "support/error_messages.h"
#include "support/temporary_folder.h"

namespace gnomon {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class WebPicture : public TemporaryFolder {};

/// A smooth grey picture with warm lights, as shadings are.
Image shading(int width, int height) {
  Image image{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double light = 0.5 + 0.4 * std::sin(0.05 * x) * std::cos(0.04 * y);
      for (const double tint : {1.0, 0.95, 0.88}) {
        image.rgb.push_back(static_cast<std::uint8_t>(std::lround(255 * light * tint)));
      }
    }
  }
  return image;
}

double rootMeanSquare(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) {
    sum += std::pow(static_cast<double>(a.rgb[i]) - b.rgb[i], 2);
  }
  return std::sqrt(sum / static_cast<double>(a.rgb.size()));
}

std::string decoded(const std::string& base64) {
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int held = 0;
  for (const char c : base64.substr(0, base64.find('='))) {
    bits = (bits << 6) | static_cast<unsigned>(alphabet.find(c));
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes += static_cast<char>((bits >> held) & 0xFF);
  }
  return bytes;
}

TEST_F(WebPicture, LosesNothingThatOneSeesAndMostOfItsBytes) {
  const Image picture = shading(300, 200);
  const std::string address = webPicture(picture, fineQuality);
  const std::string opening = "data:image/webp;base64,";
  ASSERT_THAT(address, StartsWith(opening));
  const std::string bytes = decoded(address.substr(opening.size()));
  writeTextAtomically(file("p.webp"), bytes);
  const Image back = readImage(file("p.webp"));
  ASSERT_EQ(back.width, 300);
  ASSERT_EQ(back.height, 200);
  EXPECT_LT(rootMeanSquare(picture, back), 1.5);
  writePng(file("p.png"), picture);
  EXPECT_LT(bytes.size(), readFile(file("p.png")).size() / 2);
  EXPECT_EQ(webPicture(picture, fineQuality), address);
  EXPECT_LT(webPicture(picture, smallQuality).size(), address.size());
}

TEST_F(WebPicture, RefusesWhatWebPCannotHold) {
  EXPECT_THAT(messageOf<InternalError>([] { (void)webPicture(Image{}, 90); }), HasSubstr("0 x 0"));
  EXPECT_THAT(messageOf<InternalError>([] { (void)webPicture(shading(16384, 1), 90); }),
              HasSubstr("16384"));
}

}  // namespace
}  // namespace gnomon
