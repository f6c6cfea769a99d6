#include "relief/height_image.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <vector>

#include "common/error.h"
#include "support/error_messages.h"
#include "support/temporary_folder.h"

namespace gnomon::relief {
namespace {
using ::testing::AllOf;
using ::testing::HasSubstr;

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

}  // namespace
}  // namespace gnomon::relief
