#include "image/web_picture.h"

#include <gmock/gmock.h>

#include <cmath>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "image/images.h"
#include "support/error_messages.h"
#include "support/read_image.h"
#include "support/temporary_folder.h"

namespace gnomon::image {
namespace {

using ::testing::HasSubstr;

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

TEST_F(WebPicture, LosesNothingThatOneSeesAndMostOfItsBytes) {
  const Image picture = shading(300, 200);
  const std::string bytes = webPicture(picture, fineQuality);
  writeTextAtomically(file("p.webp"), bytes);
  const Image back = test::readImage(file("p.webp"));
  ASSERT_EQ(back.width, 300);
  ASSERT_EQ(back.height, 200);
  EXPECT_LT(rootMeanSquare(picture, back), 1.5);
  writePng(file("p.png"), picture);
  EXPECT_LT(bytes.size(), readFile(file("p.png")).size() / 2);
  EXPECT_EQ(webPicture(picture, fineQuality), bytes);
  EXPECT_LT(webPicture(picture, smallQuality).size(), bytes.size());
}

TEST_F(WebPicture, RefusesWhatWebPCannotHold) {
  EXPECT_THAT(messageOf<InternalError>([] { (void)webPicture(Image{}, 90); }), HasSubstr("0 x 0"));
  EXPECT_THAT(messageOf<InternalError>([] { (void)webPicture(shading(16384, 1), 90); }),
              HasSubstr("16384"));
}

}  // namespace
}  // namespace gnomon::image
