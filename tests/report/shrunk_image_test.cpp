#include "report/shrunk_image.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <gtest/gtest.h>

#include <random>

namespace gnomon {
namespace {

/// Every pixel another colour: the hardest picture for rounding.
Image noise(int width, int height) {
  std::minstd_rand random(7);
  Image image{width, height, {}};
  for (int i = 0; i < 3 * width * height; ++i) {
    image.rgb.push_back(static_cast<std::uint8_t>(random() >> 8));
  }
  return image;
}

Image shrunkByOpenImageIO(Image image, int width, int height) {
  const OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::UINT8);
  const OIIO::ImageBuf source(spec, image.rgb.data());
  const OIIO::ROI target(0, width, 0, height, 0, 1, 0, 3);
  Image small{width, height,
              std::vector<std::uint8_t>(3UL * static_cast<std::size_t>(width * height))};
  EXPECT_TRUE(OIIO::ImageBufAlgo::resize(source, "lanczos3", 0, target)
                  .get_pixels(target, OIIO::TypeDesc::UINT8, small.rgb.data()));
  return small;
}

TEST(ShrunkImage, IsOpenImageIOsToTheBit) {
  struct Case {
    int width, height, side, shrunkWidth, shrunkHeight;
  };
  for (const Case& c : {Case{1024, 1024, 600, 600, 600}, Case{301, 200, 60, 60, 40},
                        Case{97, 640, 639, 97, 639}, Case{40, 1000, 10, 1, 10}}) {
    const Image image = noise(c.width, c.height);
    const Image small = shrunk(image, c.side);
    ASSERT_EQ(small.width, c.shrunkWidth);
    ASSERT_EQ(small.height, c.shrunkHeight);
    EXPECT_EQ(small.rgb, shrunkByOpenImageIO(image, c.shrunkWidth, c.shrunkHeight).rgb)
        << c.width << " x " << c.height << " to " << c.side;
  }
}

TEST(ShrunkImage, LeavesWhatIsSmallEnough) {
  const Image image = noise(30, 20);
  EXPECT_EQ(shrunk(image, 30).rgb, image.rgb);
  EXPECT_EQ(shrunk(noise(1000, 1), 10).height, 1);
}

}  // namespace
}  // namespace gnomon
