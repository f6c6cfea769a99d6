#include "horizon/table_file.h"

#include <OpenImageIO/imageio.h>
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <random>

#include "common/error.h"
#include "support/error_messages.h"
#include "support/temporary_folder.h"

namespace gnomon::horizon {
namespace {
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
  tables.layers = azimuths;
  tables.radiusTexels = 100.0 / 3;
  tables.wrap = relief::Wrap::clamp;
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
  EXPECT_EQ(a.layers, b.layers);
  EXPECT_EQ(a.radiusTexels, b.radiusTexels);
  EXPECT_EQ(a.wrap, b.wrap);
  expectEqual(a.horizon, b.horizon);
  expectEqual(a.distance, b.distance);
}

/// The tables that a file holds, as another library reads it.
StoredHorizons readByAnother(const std::filesystem::path& path) {
  const auto image = OIIO::ImageInput::open(path.string());
  if (!image) throw std::runtime_error(OIIO::geterror());
  const OIIO::ImageSpec& spec = image->spec();
  const auto number = [&](const char* name) { return spec.get_float_attribute(name, NAN); };
  StoredHorizons tables;
  tables.width = spec.width;
  tables.height = spec.height;
  tables.layers = spec.get_int_attribute("gnomon:azimuths");
  tables.radiusTexels = std::stod(std::string(spec.get_string_attribute("gnomon:radiusTexels")));
  tables.wrap = spec.get_string_attribute("gnomon:wrap") == "repeat" ? relief::Wrap::repeat
                                                                     : relief::Wrap::clamp;
  const auto bits = static_cast<TableBits>(spec.get_int_attribute("gnomon:bits"));
  const auto entries =
      static_cast<std::size_t>(spec.image_pixels()) * static_cast<std::size_t>(tables.layers);
  tables.horizon =
      emptyTable(entries, bits, number("gnomon:horizonLow"), number("gnomon:horizonHigh"));
  tables.distance =
      emptyTable(entries, bits, number("gnomon:distanceLow"), number("gnomon:distanceHigh"));
  EXPECT_EQ(spec.nchannels, 2 * tables.layers);
  const auto size = static_cast<std::size_t>(bits) / 8;
  const OIIO::TypeDesc type =
      bits == TableBits::sixteen ? OIIO::TypeDesc::UINT : OIIO::TypeDesc::FLOAT;
  std::vector<std::uint32_t> words(spec.image_pixels());
  for (int m = 0; m < tables.layers; ++m) {
    for (const bool isDistance : {false, true}) {
      const int c =
          spec.channelindex(fmt::format("{}.{:03}", isDistance ? "distance" : "horizon", m));
      EXPECT_TRUE(image->read_image(0, 0, c, c + 1, type, words.data()));
      // The image's first row is the tables' last.
      auto* entry = (isDistance ? tables.distance : tables.horizon).bytes.data() +
                    static_cast<std::size_t>(m) * words.size() * size;
      for (int y = spec.height - 1; y >= 0; --y) {
        for (int x = 0; x < spec.width; ++x, entry += size) {
          const std::uint32_t word = words[static_cast<std::size_t>(y * spec.width + x)];
          const auto code = bits == TableBits::eight
                                ? static_cast<std::uint32_t>(std::bit_cast<float>(word))
                                : word;
          std::memcpy(entry, &code, size);
        }
      }
    }
  }
  return tables;
}

class TableFile : public TemporaryFolder {};

TEST_F(TableFile, HoldsTheSameBytes) {
  for (const TableBits bits : {TableBits::eight, TableBits::sixteen, TableBits::thirtyTwo}) {
    StoredHorizons tables = randomTables(37, 21, 5, bits);
    writeHorizons(file("t.exr"), tables);
    expectEqual(readByAnother(file("t.exr")), tables);
    tables.wrap = relief::Wrap::repeat;
    writeHorizons(file("t.exr"), tables);
    EXPECT_EQ(readByAnother(file("t.exr")).wrap, relief::Wrap::repeat);
  }
}

TEST_F(TableFile, HoldsEveryCode) {
  for (const TableBits bits : {TableBits::eight, TableBits::sixteen}) {
    const int codes = 1 << static_cast<int>(bits);
    std::vector<float> values;
    for (int code = 0; code < codes; ++code) values.push_back(static_cast<float>(code));
    StoredHorizons tables{
        {codes / 16, 16, 1}, 8, storeTable(values, bits), storeTable(values, bits)};
    writeHorizons(file("t.exr"), tables);
    expectEqual(readByAnother(file("t.exr")), tables);
  }
}

TEST_F(TableFile, HoldsManyAzimuths) {
  for (const int azimuths : {1, 256}) {
    const StoredHorizons tables = randomTables(9, 3, azimuths, TableBits::eight);
    writeHorizons(file("t.exr"), tables);
    expectEqual(readByAnother(file("t.exr")), tables);
  }
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

}  // namespace
}  // namespace gnomon::horizon
