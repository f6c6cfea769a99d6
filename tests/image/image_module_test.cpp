#include "image/image_module.h"

#include <OpenImageIO/imageio.h>
#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <numeric>

#include "common/error.h"
#include "image/channel_image.h"
#include "image/image_file.h"
#include "support/temporary_folder.h"

namespace gnomon::image {
namespace {

class ImageFiles : public TemporaryFolder {
 protected:
  ImageFiles() { std::iota(values_.begin(), values_.end(), 0.0F); }

  /// 3 × 4 pixels of two channels, 0, 1, 2 … in one row after the other.
  void writeCounting(NumberType numbers) const {
    writeExr(path(), {3, 4, {"b", "a"}, numbers, attributes()}, counting());
  }
  [[nodiscard]] ImageRows counting() const {
    return {NumberType::float32, 3, [&](int top, int) { return values_.data() + 6 * top; }};
  }

  static ImageAttributes attributes() {
    return {{"test:count", 7}, {"test:share", 0.25F}, {"test:name", std::string("columns")}};
  }
  [[nodiscard]] std::filesystem::path path() const { return file("counting.exr"); }

  std::array<float, 24> values_{};
};

TEST_F(ImageFiles, TellsWhatItHolds) {
  writeCounting(NumberType::half);
  const ImageFacts facts = ImageFile(path()).facts();
  EXPECT_EQ(facts.data.width, 3);
  EXPECT_EQ(facts.data.height, 4);
  EXPECT_EQ(facts.display.height, 4);
  EXPECT_EQ(facts.depth, 1);
  EXPECT_EQ(facts.channelCount(), 2);
  EXPECT_GE(facts.channel("a"), 0);
  EXPECT_GE(facts.channel("b"), 0);
  EXPECT_EQ(facts.channel("c"), -1);
  EXPECT_EQ(facts.channelNumbers, std::vector<std::string>(2, nameOf(NumberType::half)));
  EXPECT_EQ(facts.coding, "zip");
  EXPECT_EQ(facts.bytesAPixel, 4);
  const auto another = OIIO::ImageInput::open(path().string());
  ASSERT_TRUE(another);
  EXPECT_EQ(another->spec().get_int_attribute("test:count"), 7);
  EXPECT_EQ(another->spec().get_float_attribute("test:share"), 0.25F);
  EXPECT_EQ(another->spec().get_string_attribute("test:name"), "columns");
}

TEST_F(ImageFiles, GivesBackWhatWasWritten) {
  writeCounting(NumberType::float32);
  ImageFile image(path());
  const int b = image.facts().channel("b");
  std::vector<float> values;
  image.readPlaced(b, b + 1, [&](const float* pixels, int column, int row, int count) {
    EXPECT_EQ(column, 0);
    EXPECT_EQ(values.size(), static_cast<std::size_t>(3 * row));
    values.insert(values.end(), pixels, pixels + count);
  });
  ASSERT_EQ(values.size(), 12U);
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(values[i], 2 * i);

  // From the top again, row after row.
  ASSERT_TRUE(image.goTo(0));
  std::array<float, 6> row{};
  for (int y = 0; y < 3; ++y) image.readRows(1, 0, 2, row.data());
  EXPECT_EQ(row[static_cast<std::size_t>(b)], 12);
  EXPECT_EQ(row[static_cast<std::size_t>(2 + b)], 14);
}

TEST_F(ImageFiles, HasPartsUpToItsLast) {
  writeCounting(NumberType::uint32);
  ImageFile image(path());
  EXPECT_TRUE(image.goTo(0));
  EXPECT_FALSE(image.goTo(1));
}

TEST_F(ImageFiles, IsTheSameBytesAgain) {
  const auto content = [&] {
    std::ifstream in(path(), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  writeCounting(NumberType::float32);
  const std::string first = content();
  EXPECT_FALSE(first.empty());
  writeCounting(NumberType::float32);
  EXPECT_EQ(content(), first);
  // So are the bytes that are asked for without a file.
  const ExrDescription exr{3, 4, {"b", "a"}, NumberType::float32, attributes()};
  EXPECT_EQ(imageModule().writeExr({}, exr, counting()), first);
}

TEST_F(ImageFiles, ThatIsMissingOrDamagedIsAnError) {
  EXPECT_THROW(ImageFile(file("missing.png")), InputError);
  const int closed = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  ::close(closed);
  EXPECT_THROW((void)imageModule().writeExr(closed, {3, 4, {"b", "a"}, {}, {}}, counting()),
               ImageError);
  writeCounting(NumberType::float32);
  std::filesystem::resize_file(path(), std::filesystem::file_size(path()) - 20);
  ImageFile image(path());
  std::vector<float> values(24);
  EXPECT_THROW(image.readRows(4, 0, 2, values.data()), InputError);
}

}  // namespace
}  // namespace gnomon::image
