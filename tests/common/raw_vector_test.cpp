#include "common/raw_vector.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <new>
#include <numeric>

namespace gnomon {
namespace {

std::uintptr_t addressOf(const void* data) {
  return reinterpret_cast<std::uintptr_t>(data);
}

TEST(RawVector, StartsAtACacheLineAndLargeOnesAtAHugePage) {
  for (const std::size_t count : {1U, 3U, 100U, 4097U}) {
    const RawVector<float> values(count, 1.F);
    EXPECT_EQ(addressOf(values.data()) % 64, 0U) << count;
  }
  const RawVector<float> large(std::size_t{1} << 20);
  EXPECT_EQ(addressOf(large.data()) % (std::size_t{1} << 21), 0U);
}

TEST(RawVector, KeepsItsValuesWhereItGrows) {
  RawVector<int> values(1000);
  std::iota(values.begin(), values.end(), 0);
  values.resize(3'000'000);
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(values[static_cast<std::size_t>(i)], i);
}

TEST(RawVector, TakesTheValuesThatItIsGiven) {
  const RawVector<float> values(5, 2.5F);
  EXPECT_EQ(values, (RawVector<float>{2.5F, 2.5F, 2.5F, 2.5F, 2.5F}));
}

TEST(RawVector, MoreThanCanBeAddressedIsRefused) {
  RawAllocator<double> allocator;
  EXPECT_THROW(allocator.allocate(std::numeric_limits<std::size_t>::max() / 4), std::bad_alloc);
}

}  // namespace
}  // namespace gnomon
