#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "image/images.h"
#include "image/web_picture.h"
#include "support/temporary_folder.h"

namespace gnomon::image {
namespace {

class Encoders : public TemporaryFolder {
 protected:
  /// What a reader that is not ours finds, three values a pixel.
  std::vector<std::uint8_t> readByAnother(const char* name, int width, int height) {
    const auto reader = OIIO::ImageInput::open(file(name).string());
    if (!reader) throw std::runtime_error(OIIO::geterror());
    EXPECT_EQ(reader->spec().width, width);
    EXPECT_EQ(reader->spec().height, height);
    EXPECT_EQ(reader->spec().nchannels, 3);
    EXPECT_EQ(reader->spec().format, OIIO::TypeDesc::UINT8);
    std::vector<std::uint8_t> values(3 * reader->spec().image_pixels());
    EXPECT_TRUE(reader->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, values.data()));
    return values;
  }
  void expectReadBack(int width, int height, const std::vector<std::uint8_t>& rgb) {
    writeTextAtomically(file("p.png"), pngOf(Image{width, height, rgb}));
    EXPECT_EQ(readByAnother("p.png", width, height), rgb) << width << " x " << height;
  }
};

std::vector<std::uint8_t> noise(int width, int height) {
  std::minstd_rand random(5);
  std::vector<std::uint8_t> rgb(3 * static_cast<std::size_t>(width * height));
  for (std::uint8_t& value : rgb) value = static_cast<std::uint8_t>(random() >> 8);
  return rgb;
}

TEST_F(Encoders, APngHoldsEveryValue) {
  expectReadBack(1, 1, {1, 2, 3});
  expectReadBack(301, 7, noise(301, 7));
  expectReadBack(2, 400, noise(2, 400));
  expectReadBack(640, 480, noise(640, 480));
}

TEST_F(Encoders, APngOfFewColoursIsSmall) {
  std::vector<std::uint8_t> rgb(3 * 512 * 512, 255);
  for (std::size_t i = 0; i < rgb.size() / 2; ++i) rgb[i] = 40;
  expectReadBack(512, 512, rgb);
  const Image image{512, 512, rgb};
  EXPECT_LT(pngOf(image).size(), rgb.size() / 200);
  EXPECT_EQ(pngOf(image), pngOf(image));
}

TEST_F(Encoders, AWebPIsShrunkToMeansOfAreas) {
  // Squares of four pixels, each of one colour: shrunk to half, one pixel a square.
  constexpr int side = 120;
  std::vector<std::uint8_t> rgb;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < 2 * side; ++x) {
      const int grey = 60 + (x / 2 % 30) + 2 * (y / 2 % 50);
      // Within a square 20 above and below it, so that only the mean is right.
      const int value = grey + ((x + y) % 2 == 0 ? 20 : -20);
      rgb.insert(rgb.end(), 3, static_cast<std::uint8_t>(value));
    }
  }
  writeTextAtomically(file("p.webp"), webPicture({2 * side, side, rgb}, 100, side));
  const std::vector<std::uint8_t> back = readByAnother("p.webp", side, side / 2);
  double squares = 0;
  for (int y = 0; y < side / 2; ++y) {
    for (int x = 0; x < side; ++x) {
      const double off =
          back[3 * static_cast<std::size_t>(side * y + x)] - (60 + x % 30 + 2 * (y % 50));
      squares += off * off;
    }
  }
  EXPECT_LT(std::sqrt(squares / (side * side / 2)), 2);
}

TEST_F(Encoders, RefuseWhatTheirFormatsCannotHold) {
  const auto black = [](int width, int height) {
    return Image{width, height,
                 std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width * height))};
  };
  EXPECT_THROW((void)pngOf(black(0, 4)), InternalError);
  EXPECT_THROW((void)pngOf(black(2'000'000, 1)), InternalError);
  EXPECT_THROW((void)webPicture(black(20000, 1), 90), InternalError);
  EXPECT_EQ(webPicture(black(4, 2), 90).substr(8, 4), "WEBP");
  EXPECT_EQ(webPicture(black(4000, 1), 90, 10).substr(8, 4), "WEBP");
}

}  // namespace
}  // namespace gnomon::image
