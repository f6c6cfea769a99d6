#include "image_files/image_library.h"

#include <array>
#include <fstream>
#include <numeric>

#include "image_files/image_error.h"
#include "support/temporary_folder.h"

namespace gnomon {
namespace {

class ImageFile : public TemporaryFolder {
 protected:
  /// 3 × 4 pixels of two channels, 0, 1, 2 … in one row after the other.
  void writeCounting(NumberType numbers) const {
    std::vector<float> values(24);
    std::iota(values.begin(), values.end(), 0.0F);
    const auto exr = imageLibrary().createExr(path(), {3, 4, {"b", "a"}, numbers, attributes()});
    exr->writeRows(0, 3, NumberType::float32, values.data());
    exr->writeRows(3, 4, NumberType::float32, values.data() + 18);
    exr->close();
  }

  static ImageAttributes attributes() {
    return {{"test:count", 7}, {"test:share", 0.25F}, {"test:name", std::string("columns")}};
  }
  [[nodiscard]] std::filesystem::path path() const { return file("counting.exr"); }
};

TEST_F(ImageFile, TellsWhatItHolds) {
  writeCounting(NumberType::half);
  const ImageFacts facts = imageLibrary().open(path())->facts();
  EXPECT_EQ(facts.data.width, 3);
  EXPECT_EQ(facts.data.height, 4);
  EXPECT_EQ(facts.display.height, 4);
  EXPECT_EQ(facts.depth, 1);
  EXPECT_EQ(facts.channelCount(), 2);
  EXPECT_GE(facts.channel("a"), 0);
  EXPECT_GE(facts.channel("b"), 0);
  EXPECT_EQ(facts.channel("c"), -1);
  EXPECT_EQ(facts.channelNumbers, std::vector<std::string>(2, nameOf(NumberType::half)));
  EXPECT_EQ(facts.numbers, "half");
  EXPECT_EQ(facts.pixelCount, 12U);
  EXPECT_EQ(facts.bytesAPixel, 4U);
  for (const auto& [name, value] : attributes()) {
    ASSERT_TRUE(facts.attributes.contains(name)) << name;
    EXPECT_EQ(facts.attributes.at(name), value) << name;
  }
}

TEST_F(ImageFile, GivesBackWhatWasWritten) {
  writeCounting(NumberType::float32);
  const auto reader = imageLibrary().open(path());
  const int b = reader->facts().channel("b");
  std::vector<float> values(12);
  reader->read(b, b + 1, NumberType::float32, values.data());
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(values[i], 2 * i);

  std::array<float, 6> row{};
  reader->readRows(2, 3, NumberType::float32, row.data());
  EXPECT_EQ(row[static_cast<std::size_t>(b)], 12);
  EXPECT_EQ(row[static_cast<std::size_t>(2 + b)], 14);
}

TEST_F(ImageFile, HasPartsUpToItsLast) {
  writeCounting(NumberType::uint32);
  const auto reader = imageLibrary().open(path());
  EXPECT_TRUE(reader->goTo(0));
  EXPECT_FALSE(reader->goTo(1));
}

TEST_F(ImageFile, IsTheSameBytesAgain) {
  const auto content = [&] {
    std::ifstream in(path(), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  writeCounting(NumberType::float32);
  const std::string first = content();
  EXPECT_FALSE(first.empty());
  writeCounting(NumberType::float32);
  EXPECT_EQ(content(), first);
}

TEST_F(ImageFile, ThatIsMissingOrDamagedIsAnError) {
  EXPECT_THROW((void)imageLibrary().open(file("missing.png")), ImageError);
  EXPECT_THROW(
      (void)imageLibrary().createExr(file("no/folder.exr"), {1, 1, {"Y"}, NumberType::half, {}}),
      ImageError);
  writeCounting(NumberType::float32);
  std::filesystem::resize_file(path(), std::filesystem::file_size(path()) - 20);
  std::vector<float> values(24);
  EXPECT_THROW(imageLibrary().open(path())->read(0, 2, NumberType::float32, values.data()),
               ImageError);
}

}  // namespace
}  // namespace gnomon
