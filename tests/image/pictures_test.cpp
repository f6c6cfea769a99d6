#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <random>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "image/images.h"
#include "image/mask_picture.h"
#include "support/error_messages.h"
#include "support/read_image.h"
#include "support/temporary_folder.h"

namespace gnomon::image {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// A folder of its own for each test, removed at its end.
class Images : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("gnomon-" + std::string(test->name()) + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_;
};

constexpr Shade lit = Shade::lit;
constexpr Shade dark = Shade::shadowed;
constexpr Shade none = Shade::none;

Rgb pixel(const Image& image, std::size_t i) {
  return {image.rgb.at(3 * i), image.rgb.at(3 * i + 1), image.rgb.at(3 * i + 2)};
}

TEST_F(Images, MasksReadBackFromTheFile) {
  const Mask mask{3, 2, {lit, dark, none, dark, dark, lit}};
  writePng(folder_ / "mask.png", maskImage(mask));
  const Mask back = readMaskPicture(folder_ / "mask.png").mask;
  EXPECT_EQ(back.width, 3);
  EXPECT_EQ(back.height, 2);
  EXPECT_EQ(back.samples, mask.samples);
}

TEST_F(Images, MasksAreEightBitGreys) {
  const Mask mask{3, 1, {lit, dark, none}};
  EXPECT_EQ(maskImage(mask).values, (std::vector<std::uint8_t>{255, 0, 128}));
  writePng(folder_ / "mask.png", maskImage(mask));
  // PNG, IHDR: bits a value and colour type (0: grey) after width and height.
  const std::string bytes = readFile(folder_ / "mask.png");
  ASSERT_GT(bytes.size(), 26U);
  EXPECT_EQ(bytes[24], 8);
  EXPECT_EQ(bytes[25], 0);
}

TEST_F(Images, DifferenceIsSigned) {
  const Mask candidate{5, 1, {lit, dark, dark, lit, none}};
  const Mask truth{5, 1, {lit, dark, lit, dark, none}};
  const Image image = unfolded(differenceImage(candidate, truth));
  EXPECT_EQ(pixel(image, 0), DifferenceColours::bothLit);
  EXPECT_EQ(pixel(image, 1), DifferenceColours::bothShadowed);
  EXPECT_EQ(pixel(image, 2), DifferenceColours::falseShadow);
  EXPECT_EQ(pixel(image, 3), DifferenceColours::falseLight);
  EXPECT_EQ(pixel(image, 4), DifferenceColours::none);
}

TEST_F(Images, DifferenceRefusesMasksOfDifferentViews) {
  EXPECT_THROW(differenceImage(Mask{1, 1, {lit}}, Mask{2, 1, {lit, lit}}), InputError);
  EXPECT_THROW(differenceImage(Mask{1, 1, {lit}}, Mask{1, 1, {none}}), InputError);
  EXPECT_THROW(differenceImage(Mask{2, 2, {lit}}, Mask{2, 2, {lit}}), InternalError);
}

/// Linear light of an sRGB value (IEC 61966-2-1).
double linear(std::uint8_t value) {
  const double v = value / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

/// The colour as full deuteranopia or protanopia sees it, in linear RGB (Viénot, Brettel & Mollon
/// 1999: project on the plane of what remains, in their LMS space).
std::array<double, 3> asSeenBy(const Rgb& colour, bool protanope) {
  const double r = linear(colour[0]);
  const double g = linear(colour[1]);
  const double b = linear(colour[2]);
  double l = 17.8824 * r + 43.5161 * g + 4.11935 * b;
  double m = 3.45565 * r + 27.1554 * g + 3.86714 * b;
  const double s = 0.0299566 * r + 0.184309 * g + 1.46709 * b;
  if (protanope) {
    l = 2.02344 * m - 2.52581 * s;
  } else {
    m = 0.494207 * l + 1.24827 * s;
  }
  return {0.080944 * l - 0.130504 * m + 0.116721 * s, -0.0102485 * l + 0.0540194 * m - 0.113615 * s,
          -0.000365294 * l - 0.00412163 * m + 0.693513 * s};
}

/// Distance in CIE L*a*b* (1976, D65) of two colours in linear RGB.
double labDistance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  const auto lab = [](const std::array<double, 3>& c) {
    const auto f = [](double t) {
      return t > 216.0 / 24389 ? std::cbrt(t) : t * 841 / 108 + 4.0 / 29;
    };
    const double x = f((0.4124 * c[0] + 0.3576 * c[1] + 0.1805 * c[2]) / 0.9505);
    const double y = f(0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]);
    const double z = f((0.0193 * c[0] + 0.1192 * c[1] + 0.9505 * c[2]) / 1.089);
    return std::array<double, 3>{116 * y - 16, 500 * (x - y), 200 * (y - z)};
  };
  const auto p = lab(a);
  const auto q = lab(b);
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

TEST_F(Images, DifferenceColoursStayApartForTheColourBlind) {
  const std::array colours = {DifferenceColours::falseShadow, DifferenceColours::falseLight,
                              DifferenceColours::bothLit, DifferenceColours::bothShadowed,
                              DifferenceColours::none};
  for (const bool protanope : {false, true}) {
    for (std::size_t i = 0; i < colours.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        // 2.3 is just noticeable. Errors are held far from all else, greys from each other less.
        const double least = j < 2 ? 25 : 9;
        EXPECT_GT(labDistance(asSeenBy(colours[i], protanope), asSeenBy(colours[j], protanope)),
                  least)
            << i << " and " << j << (protanope ? ", protanope" : ", deuteranope");
      }
    }
  }
}

TEST_F(Images, RefusesImagesThatAreNotWhole) {
  EXPECT_THROW(writePng(folder_ / "a.png", Image{2, 2, {1, 2, 3}}), InternalError);
  EXPECT_THROW(writePng(folder_ / "a.png", Image{-1, -1, {1, 2, 3}}), InternalError);
  EXPECT_THROW(writePng(folder_ / "a.png", Image{}), InternalError);
  EXPECT_TRUE(fs::is_empty(folder_));
  EXPECT_THROW(maskImage(Mask{2, 2, {}}), InternalError);
}

TEST_F(Images, AFileThatCannotBeWrittenIsAnError) {
  fs::create_directories(folder_ / "taken.png" / "inside");
  EXPECT_THROW(writePng(folder_ / "taken.png", maskImage(Mask{1, 1, {lit}})), InputError);
}

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
