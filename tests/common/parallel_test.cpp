#include "common/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <vector>

#include "common/error.h"

namespace gnomon {
namespace {

TEST(ParallelFor, CallsTheBodyOnceForEachIndex) {
  for (const std::size_t grain : {1U, 7U, 5000U}) {
    std::vector<std::atomic<int>> calls(1000);
    parallelFor(
        100, 900, [&](std::size_t i) { ++calls[i]; }, grain);
    for (std::size_t i = 0; i < calls.size(); ++i) {
      ASSERT_EQ(calls[i], i >= 100 && i < 900 ? 1 : 0) << i;
    }
  }
}

TEST(ParallelFor, DoesNothingOnAnEmptyRange) {
  parallelFor(5, 5, [](std::size_t) { FAIL(); });
}

TEST(ParallelFor, HandsAnErrorToItsCaller) {
  const auto work = [](std::size_t i) {
    if (i == 613) throw InputError("index 613");
  };
  EXPECT_THROW(parallelFor(0, 1000, work), InputError);
}

}  // namespace
}  // namespace gnomon
