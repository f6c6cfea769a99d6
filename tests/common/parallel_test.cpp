#include "common/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <vector>

#include "common/cancellation.h"
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

#if !defined(__SANITIZE_THREAD__)  // where loops do not go by TBB

TEST(ParallelFor, EndsWhereItsWorkIsCancelledAtAnyDepth) {
  Cancellation cancellation;
  std::atomic<int> begun = 0;
  const auto endless = [&](std::size_t) {
    parallelFor(0, std::size_t{1} << 26U, [&](std::size_t) {
      if (++begun == 1000) cancellation.cancel();
    });
    ADD_FAILURE() << "a loop that was cut short must not look like one that ended";
  };
  EXPECT_THROW(cancellation.run([&] { parallelFor(0, 4, endless); }), Cancelled);
  EXPECT_GE(begun, 1000);
  EXPECT_FALSE(isCancelled()) << "other work of this thread goes on";
  parallelFor(0, 1, [](std::size_t) {});
}

#endif

TEST(Cancellation, IsAWishAndNoMore) {
  Cancellation cancellation;
  int done = 0;
  cancellation.run([&] { ++done; });
  EXPECT_EQ(done, 1);
  EXPECT_THROW(Cancellation().run([] { throw InputError("its own"); }), InputError);
  Cancellation early;
  early.cancel();
  EXPECT_THROW(early.run([&] { ++done; }), Cancelled);
  EXPECT_EQ(done, 1);
  EXPECT_THROW(Cancellation().run([&] {
    early.cancel();
    throwIfCancelled();
    throw InputError("of another");
  }),
               InputError);
}

}  // namespace
}  // namespace gnomon
