#include "horizon/stored_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "common/error.h"
#include "support/error_messages.h"

namespace gnomon::horizon {
namespace {
using ::testing::HasSubstr;

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

}  // namespace
}  // namespace gnomon::horizon
