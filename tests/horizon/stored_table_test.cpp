#include <OpenImageIO/imageio.h>
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "common/error.h"
#include "horizon/horizon_bake.h"
#include "horizon/stored_table.h"
#include "support/error_messages.h"
#include "support/temporary_folder.h"

#if defined(__GLIBC__)
#include <malloc.h>
#endif
#include <algorithm>
#include <cstddef>
#include <fstream>
#include <string>
#include "horizon/horizon_truth.h"

namespace gnomon::horizon {
namespace {

using ::testing::HasSubstr;

class StoredBakeOf : public ::testing::TestWithParam<TableBits> {};

TEST_P(StoredBakeOf, IsTheFloatsStoredToTheByte) {
  for (const relief::Wrap wrap : {relief::Wrap::repeat, relief::Wrap::clamp}) {
    const relief::HeightField field = noise(150, 70, wrap, 5);
    const HorizonTables floats = bakeHorizons(field, {9, 40});
    const StoredHorizons stored = bakeStoredHorizons(field, {9, 40}, GetParam());
    const auto expectSame = [](const StoredTable& a, const StoredTable& b) {
      EXPECT_EQ(a.bits, b.bits);
      EXPECT_EQ(a.low, b.low);
      EXPECT_EQ(a.high, b.high);
      EXPECT_EQ(a.bytes, b.bytes);
    };
    expectSame(stored.horizon, storeTable(floats.horizon, GetParam()));
    expectSame(stored.distance, storeTable(floats.distance, GetParam()));
    EXPECT_EQ(stored.width, 150);
    EXPECT_EQ(stored.height, 70);
    EXPECT_EQ(stored.layers, 9);
    EXPECT_EQ(stored.radiusTexels, 40);
    EXPECT_EQ(stored.wrap, wrap);
  }
}

INSTANTIATE_TEST_SUITE_P(Bits, StoredBakeOf,
                         ::testing::Values(TableBits::eight, TableBits::sixteen,
                                           TableBits::thirtyTwo));

TEST(StoredBake, ReportsProgressOnceFromZeroToOne) {
  double last = 0;
  bakeStoredHorizons(noise(300, 200, relief::Wrap::repeat), {8, 10}, TableBits::eight,
                     [&](double share) {
                       EXPECT_GT(share, last);
                       last = share;
                     });
  EXPECT_EQ(last, 1);
}

TEST(StoredBake, RefusesWhatBakesRefuse) {
  const relief::HeightField field = noise(4, 4, relief::Wrap::repeat);
  EXPECT_THAT(messageOf<InputError>([&] {
                bakeStoredHorizons(field, {0, 5}, TableBits::eight);
              }),
              ::testing::StartsWith("azimuths: "));
  EXPECT_THAT(messageOf<MemoryError>([&] {
                bakeStoredHorizons(field, {2000000000, 5}, TableBits::eight);
              }),
              ::testing::StartsWith("azimuths: "));
}

#if defined(__linux__) && !defined(GNOMON_SANITIZED)
double statusBytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kilobytes = 0;
    if (word == key + ":" && status >> kilobytes) return 1024 * kilobytes;
  }
  return 0;
}

/// Resident bytes that a call needs at its peak over those before it.
template <typename Call>
double peakBytes(const Call& call) {
#if defined(__GLIBC__)
  malloc_trim(0);  // else memory that others freed would serve, unseen
#endif
  std::ofstream("/proc/self/clear_refs") << 5;
  const double before = statusBytes("VmRSS");
  call();
  return statusBytes("VmHWM") - before;
}

TEST(StoredBake, TakesLessThanTwiceItsTables) {
  const relief::HeightField field = noise(512, 512, relief::Wrap::repeat);
  const BakeSettings settings{48, 6};
  double tables = 0;
  const double streamed = peakBytes([&] {
    tables = static_cast<double>(bakeStoredHorizons(field, settings, TableBits::eight).byteCount());
  });
  EXPECT_EQ(tables, 2.0 * 512 * 512 * 48);
  EXPECT_GT(streamed, 0.9 * tables);  // some may lie in memory that was freed before
  EXPECT_LT(streamed, 2 * tables);
  const double floats = peakBytes([&] { bakeHorizons(field, settings); });
  EXPECT_GT(floats, 3 * tables) << "the measure sees nothing";
}
#endif

std::vector<float> randomValues(float low, float high) {
  std::mt19937 random(3);
  std::vector<float> values(5000);
  for (float& v : values) v = std::lerp(low, high, static_cast<float>(random()) * 0x1p-32F);
  return values;
}

class StoredTableOf : public ::testing::TestWithParam<TableBits> {};

TEST_P(StoredTableOf, NoEntryIsOffByMoreThanHalfAStep) {
  for (const auto& [low, high] : {std::pair{-2.5F, 7.F}, {0.F, 1e-20F}, {1000.F, 1000.5F}}) {
    const std::vector<float> values = randomValues(low, high);
    const StoredTable table = storeTable(values, GetParam());
    ASSERT_EQ(table.entryCount(), values.size());
    const double codes = std::exp2(static_cast<int>(GetParam())) - 1;
    const double step = (static_cast<double>(table.high) - table.low) / codes;
    // A decoded value is itself rounded to a float.
    const double rounding = 0x1p-24 * std::max(std::abs(low), std::abs(high));
    double worst = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      worst = std::max(worst, std::abs(static_cast<double>(table.value(i)) - values[i]));
    }
    EXPECT_LE(worst, 0.5 * step * (1 + 1e-9) + rounding);
    if (GetParam() == TableBits::eight) {
      EXPECT_GT(worst, 0.4 * step) << "the test sees nothing";
    }
  }
}

TEST_P(StoredTableOf, TheExtremesAreExact) {
  for (const auto& [low, high] :
       {std::pair{-0.1F, 0.3F},
        {-1e30F, 1e-10F},
        {0.F, 77.7F},
        {-std::numeric_limits<float>::max(), std::numeric_limits<float>::max()}}) {
    const StoredTable table = storeTable(std::array{low, high, low}, GetParam());
    EXPECT_EQ(table.value(0), low);
    EXPECT_EQ(table.value(1), high);
    EXPECT_EQ(table.value(2), low);
  }
}

TEST_P(StoredTableOf, ConstantAndEmptyTablesWork) {
  for (const float constant : {0.F, -3.25F, 1e30F}) {
    const StoredTable table = storeTable(std::array{constant, constant}, GetParam());
    EXPECT_EQ(table.value(0), constant);
    EXPECT_EQ(table.value(1), constant);
  }
  EXPECT_EQ(storeTable({}, GetParam()).entryCount(), 0U);
}

TEST_P(StoredTableOf, TakesTheBitsItSays) {
  EXPECT_EQ(storeTable(std::vector<float>(64, 1.F), GetParam()).bytes.size(),
            64 * static_cast<std::size_t>(GetParam()) / 8);
}

TEST_P(StoredTableOf, RefusesWhatIsNotFinite) {
  for (const float bad : {NAN, INFINITY, -INFINITY}) {
    EXPECT_THAT(messageOf<InputError>([&] {
                  storeTable(std::array{1.F, 2.F, bad}, GetParam());
                }),
                HasSubstr("entry 2"));
  }
}

INSTANTIATE_TEST_SUITE_P(Bits, StoredTableOf,
                         ::testing::Values(TableBits::eight, TableBits::sixteen,
                                           TableBits::thirtyTwo));

TEST(StoredTable, ThirtyTwoBitsKeepTheFloats) {
  const std::vector<float> values = randomValues(-1e10F, 3);
  const StoredTable table = storeTable(values, TableBits::thirtyTwo);
  for (std::size_t i = 0; i < values.size(); ++i) ASSERT_EQ(table.value(i), values[i]);
}

TEST(StoredTable, CodesAreWhatTheFormulaSays) {
  const StoredTable table =
      storeTable(std::array<float, 4>{0, 255, 17.4F, 17.6F}, TableBits::eight);
  EXPECT_EQ(table.bytes, (std::vector<std::uint8_t>{0, 255, 17, 18}));
}

TEST(StoredTable, ThePapersTablesTakeOneMegabyte) {
  const std::vector<float> values(std::size_t{128} * 128 * 32);
  EXPECT_EQ(2 * storeTable(values, TableBits::eight).bytes.size(), std::size_t{1} << 20);
}

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
