#include "horizon/table_file.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "support/error_messages.h"
#include "support/temporary_folder.h"

namespace gnomon {
namespace {
using ::testing::AllOf;
using ::testing::HasSubstr;

StoredHorizons randomTables(int width, int height, int azimuths, TableBits bits) {
  std::mt19937 random(9);
  const auto values = [&](float low, float high) {
    std::vector<float> v(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                         static_cast<std::size_t>(azimuths));
    for (float& x : v) x = low + (high - low) * static_cast<float>(random()) * 0x1p-32F;
    return v;
  };
  StoredHorizons tables;
  tables.width = width;
  tables.height = height;
  tables.azimuths = azimuths;
  tables.radiusTexels = 100.0 / 3;
  tables.wrap = Wrap::clamp;
  tables.horizon = storeTable(values(-0.7F, 3.1F), bits);
  tables.distance = storeTable(values(0, 33.3F), bits);
  return tables;
}

void expectEqual(const StoredTable& a, const StoredTable& b) {
  EXPECT_EQ(a.bits, b.bits);
  EXPECT_EQ(a.low, b.low);
  EXPECT_EQ(a.high, b.high);
  EXPECT_EQ(a.bytes, b.bytes);
}

void expectEqual(const StoredHorizons& a, const StoredHorizons& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.azimuths, b.azimuths);
  EXPECT_EQ(a.radiusTexels, b.radiusTexels);
  EXPECT_EQ(a.wrap, b.wrap);
  expectEqual(a.horizon, b.horizon);
  expectEqual(a.distance, b.distance);
}

class TableFile : public TemporaryFolder {};

TEST_F(TableFile, GivesBackTheSameBytes) {
  for (const TableBits bits : {TableBits::eight, TableBits::sixteen, TableBits::thirtyTwo}) {
    StoredHorizons tables = randomTables(37, 21, 5, bits);
    writeHorizons(file("t.exr"), tables);
    expectEqual(readHorizons(file("t.exr")), tables);
    tables.wrap = Wrap::repeat;
    writeHorizons(file("t.exr"), tables);
    EXPECT_EQ(readHorizons(file("t.exr")).wrap, Wrap::repeat);
  }
}

TEST_F(TableFile, HoldsEveryCode) {
  for (const TableBits bits : {TableBits::eight, TableBits::sixteen}) {
    const int codes = 1 << static_cast<int>(bits);
    std::vector<float> values;
    for (int code = 0; code < codes; ++code) values.push_back(static_cast<float>(code));
    StoredHorizons tables{
        codes / 16, 16, 1, 8, Wrap::repeat, storeTable(values, bits), storeTable(values, bits)};
    writeHorizons(file("t.exr"), tables);
    expectEqual(readHorizons(file("t.exr")), tables);
  }
}

TEST_F(TableFile, HoldsManyAzimuths) {
  for (const int azimuths : {1, 256}) {
    const StoredHorizons tables = randomTables(9, 3, azimuths, TableBits::eight);
    writeHorizons(file("t.exr"), tables);
    expectEqual(readHorizons(file("t.exr")), tables);
  }
}

TEST_F(TableFile, OtherReadersFindTheChannels) {
  const StoredHorizons tables = randomTables(4, 3, 2, TableBits::eight);
  writeHorizons(file("t.exr"), tables);
  const auto image = OIIO::ImageInput::open(file("t.exr").string());
  ASSERT_TRUE(image);
  const int channel = image->spec().channelindex("distance.001");
  ASSERT_GE(channel, 0);
  std::vector<float> codes(12);
  ASSERT_TRUE(image->read_image(0, 0, channel, channel + 1, OIIO::TypeDesc::FLOAT, codes.data()));
  // Azimuth 1, texel (3, 0): the image's last row.
  EXPECT_EQ(codes[2 * 4 + 3], static_cast<float>(tables.distance.bytes[12 + 3]));
  EXPECT_EQ(image->spec().get_int_attribute("gnomon:azimuths"), 2);
}

TEST_F(TableFile, RefusesTruncatedFiles) {
  writeHorizons(file("t.exr"), randomTables(37, 40, 3, TableBits::sixteen));
  const std::string whole = readFile(file("t.exr"));
  for (const double share : {0.0, 0.001, 0.02, 0.1, 0.5, 0.9, 0.999}) {
    writeTextAtomically(
        file("cut.exr"),
        whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))));
    EXPECT_THAT(messageOf<InputError>([&] { readHorizons(file("cut.exr")); }), HasSubstr("cut.exr"))
        << share;
  }
}

TEST_F(TableFile, DamageIsRefusedOrHarmless) {
  writeHorizons(file("t.exr"), randomTables(11, 6, 2, TableBits::eight));
  const std::string whole = readFile(file("t.exr"));
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) {
    std::string damaged = whole;
    damaged[random() % damaged.size()] = static_cast<char>(random());
    writeTextAtomically(file("bad.exr"), damaged);
    try {
      const StoredHorizons tables = readHorizons(file("bad.exr"));
      EXPECT_EQ(tables.horizon.entryCount(), static_cast<std::size_t>(tables.width) *
                                                 static_cast<std::size_t>(tables.height) *
                                                 static_cast<std::size_t>(tables.azimuths));
    } catch (const InputError&) {
    } catch (const MemoryError&) {
    }
  }
}

TEST_F(TableFile, RefusesForeignFiles) {
  EXPECT_THAT(messageOf<InputError>([&] { readHorizons(file("none.exr")); }),
              AllOf(HasSubstr("none.exr"), HasSubstr("no such file")));
  writeTextAtomically(file("text.exr"), "not an image");
  EXPECT_THROW(readHorizons(file("text.exr")), InputError);
  const auto image = OIIO::ImageOutput::create(file("photo.exr").string());
  const OIIO::ImageSpec spec(2, 2, 3, OIIO::TypeDesc::HALF);
  ASSERT_TRUE(image->open(file("photo.exr").string(), spec));
  const std::vector<float> black(12);
  ASSERT_TRUE(image->write_image(OIIO::TypeDesc::FLOAT, black.data()));
  ASSERT_TRUE(image->close());
  EXPECT_THAT(messageOf<InputError>([&] { readHorizons(file("photo.exr")); }),
              AllOf(HasSubstr("photo.exr"), HasSubstr("gnomon:azimuths")));
}

TEST_F(TableFile, RefusesEntriesThatAreNoCodes) {
  StoredHorizons tables = randomTables(4, 4, 1, TableBits::thirtyTwo);
  writeHorizons(file("t.exr"), tables);
  // The same file with other attributes or pixels, written by hand.
  const auto rewrite = [&](int bits, OIIO::TypeDesc type, float value) {
    const auto in = OIIO::ImageInput::open(file("t.exr").string());
    OIIO::ImageSpec spec = in->spec();
    spec.set_format(type);
    spec.attribute("gnomon:bits", bits);
    const auto out = OIIO::ImageOutput::create(file("u.exr").string());
    EXPECT_TRUE(out->open(file("u.exr").string(), spec));
    const std::vector<float> pixels(32, value);
    EXPECT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, pixels.data()));
    EXPECT_TRUE(out->close());
    return messageOf<InputError>([&] { readHorizons(file("u.exr")); });
  };
  EXPECT_THAT(rewrite(8, OIIO::TypeDesc::HALF, 3.5F), HasSubstr("no code of 8 bits"));
  EXPECT_THAT(rewrite(8, OIIO::TypeDesc::HALF, 256), HasSubstr("no code of 8 bits"));
  EXPECT_THAT(rewrite(32, OIIO::TypeDesc::FLOAT, NAN), HasSubstr("pixel (0, 0)"));
  EXPECT_THAT(rewrite(16, OIIO::TypeDesc::HALF, 3), HasSubstr("expected for gnomon:bits = 16"));
  EXPECT_THAT(rewrite(12, OIIO::TypeDesc::HALF, 3), HasSubstr("gnomon:bits is 12"));
}

TEST_F(TableFile, WritesWholeFilesOrNone) {
  StoredHorizons tables = randomTables(4, 4, 1, TableBits::eight);
  EXPECT_THAT(messageOf<InputError>([&] { writeHorizons(file("t.png"), tables); }),
              HasSubstr(".exr expected"));
  tables.distance.bytes.pop_back();
  EXPECT_THAT(messageOf<InputError>([&] { writeHorizons(file("t.exr"), tables); }),
              HasSubstr("t.exr"));
  EXPECT_TRUE(std::filesystem::is_empty(folder()));
}

/// Where an EXR's header keeps the last row: after the attribute's name, type and size, the fourth
/// of the window's numbers.
std::size_t lastRowPlace(const std::string& bytes) {
  const std::string name("dataWindow\0box2i\0", 17);
  return bytes.find(name) + name.size() + 4 + 12;
}

TEST_F(TableFile, AHeaderThatPromisesTooManyRowsIsRefusedBeforeTheyAreCounted) {
  writeHorizons(file("t.exr"), randomTables(4, 4, 2, TableBits::eight));
  std::string bytes = readFile(file("t.exr"));
  ASSERT_LT(lastRowPlace(bytes) + 4, bytes.size());
  bytes.replace(lastRowPlace(bytes), 4, std::string("\xff\xff\xff\x3f", 4));
  std::ofstream(file("many.exr"), std::ios::binary) << bytes;
  const auto refused = messageOf<InputError>([&] { readHorizons(file("many.exr")); });
  EXPECT_THAT(refused, AllOf(HasSubstr("many.exr"), HasSubstr("over 2^20 pixels")));
}

}  // namespace
}  // namespace gnomon
