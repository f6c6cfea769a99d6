#include "common/system/memory.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <unistd.h>

#include <cmath>
#include <limits>
#include <map>
#include <sstream>

#include "common/error.h"
#include "support/error_messages.h"

namespace gnomon {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(FormatBytes, HasThreeSignificantDigitsInDecimalUnits) {
  EXPECT_EQ(formatBytes(0), "0 B");
  EXPECT_EQ(formatBytes(999), "999 B");
  EXPECT_EQ(formatBytes(1000), "1.00 kB");
  EXPECT_EQ(formatBytes(12'345), "12.3 kB");
  EXPECT_EQ(formatBytes(123'456), "123 kB");
  EXPECT_EQ(formatBytes(128 * 128 * 32 * 2), "1.05 MB");
  EXPECT_EQ(formatBytes(2'514'000'000), "2.51 GB");
  EXPECT_EQ(formatBytes(3e12), "3.00 TB");
  EXPECT_EQ(formatBytes(4e15), "4.00 PB");
}

TEST(FormatBytes, RoundsUpIntoTheNextUnit) {
  EXPECT_EQ(formatBytes(999.4), "999 B");
  EXPECT_EQ(formatBytes(999.6), "1.00 kB");
  EXPECT_EQ(formatBytes(9'996), "10.0 kB");
  EXPECT_EQ(formatBytes(99'960), "100 kB");
  EXPECT_EQ(formatBytes(999'600), "1.00 MB");
}

TEST(FormatBytes, StaysShortBeyondTheLastUnit) {
  EXPECT_EQ(formatBytes(1.234e40), "1.23e+25 PB");
  EXPECT_EQ(formatBytes(std::numeric_limits<double>::infinity()), "inf PB");
}

TEST(FormatBytes, ReadBackIsWithinHalfAPercent) {
  const std::map<std::string, double> units = {{"B", 1},    {"kB", 1e3},  {"MB", 1e6},
                                               {"GB", 1e9}, {"TB", 1e12}, {"PB", 1e15}};
  EXPECT_TRUE(rc::check([&](std::uint64_t bytes) {
    std::istringstream text(formatBytes(static_cast<double>(bytes)));
    double value = 0;
    std::string unit;
    text >> value >> unit;
    const double back = value * units.at(unit);
    RC_ASSERT(std::abs(back - static_cast<double>(bytes)) <= 0.005001 * static_cast<double>(bytes));
  }));
}

TEST(AvailableMemory, IsSomeAndNoMoreThanTheMachineHas) {
  const double machine =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  EXPECT_GT(availableMemoryBytes(), 0U);
  EXPECT_LE(static_cast<double>(availableMemoryBytes()), machine);
}

TEST(RequireMemory, LetsPassWhatFits) {
  EXPECT_NO_THROW(requireMemory(0, "nothing"));
  EXPECT_NO_THROW(requireMemory(0.5 * static_cast<double>(availableMemoryBytes()), "half"));
}

TEST(RequireMemory, RefusesWhatDoesNotFitWithBothFigures) {
  const std::string message =
      messageOf<MemoryError>([] { requireMemory(7.5e17, "a micro-mesh", "step"); });
  EXPECT_THAT(message, StartsWith("step: a micro-mesh: needs 750 PB, "));
  EXPECT_THAT(message, HasSubstr("B available"));
}

TEST(RequireMemory, LeavesATenthFree) {
  const double available = static_cast<double>(availableMemoryBytes());
  EXPECT_THROW(requireMemory(0.97 * available, "nearly all"), MemoryError);
}

TEST(RequireMemory, RefusesWhatIsNoNumber) {
  EXPECT_THROW(requireMemory(std::nan(""), "a size gone wrong"), MemoryError);
  EXPECT_THROW(requireMemory(std::numeric_limits<double>::infinity(), "a size"), MemoryError);
}

}  // namespace
}  // namespace gnomon
