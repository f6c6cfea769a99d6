#include "horizon/stored_bake.h"

#include <gtest/gtest.h>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <string>

#include "common/error.h"
#include "horizon/horizon_truth.h"
#include "support/error_messages.h"

namespace gnomon::horizon {
namespace {

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

}  // namespace
}  // namespace gnomon::horizon
