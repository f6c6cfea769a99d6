#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "common/error.h"
#include "common/parallel.h"
#include "common/progress.h"

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

TEST(BackgroundWork, GoesOnWhileItsOwnerGoesOn) {
  BackgroundWork beside;
  std::promise<void> allowed;
  std::atomic<bool> isDone = false;
  beside.start([&] {
    allowed.get_future().wait();
    isDone = true;
  });
  EXPECT_FALSE(isDone);
  allowed.set_value();
  beside.wait();
  EXPECT_TRUE(isDone);
}

TEST(BackgroundWork, IsOnePieceAfterTheOther) {
  BackgroundWork beside;
  std::string order;
  for (const char letter : std::string("abcdefgh"))
    beside.start([&order, letter] { order += letter; });
  beside.finish();
  EXPECT_EQ(order, "abcdefgh");
}

TEST(BackgroundWork, ThrowsWhatAPieceThrew) {
  BackgroundWork beside;
  const auto fails = [] { throw std::runtime_error("full"); };
  beside.start(fails);
  beside.wait();
  EXPECT_THROW(beside.start([] { FAIL() << "a later piece"; }), std::runtime_error);
  beside.start(fails);
  EXPECT_THROW(beside.finish(), std::runtime_error);
  beside.finish();  // thrown once
}

TEST(BackgroundWork, EndsBeforeItsOwner) {
  std::atomic<bool> isDone = false;
  {
    BackgroundWork beside;
    beside.start([&] { isDone = true; });
  }
  EXPECT_TRUE(isDone);
}

TEST(Alongside, CallsBothTheFirstOnThisThread) {
  for (int i = 0; i < 100; ++i) {
    std::thread::id where;
    std::atomic<int> calls = 0;
    alongside([&] { where = std::this_thread::get_id(); }, [&] { ++calls; });
    EXPECT_EQ(where, std::this_thread::get_id());
    ASSERT_EQ(calls, 1);
  }
}

TEST(Alongside, HandsAnErrorOfEitherToItsCaller) {
  const auto nothing = [] {};
  const auto fail = [] { throw InputError("one of two"); };
  for (int i = 0; i < 20; ++i) {
    EXPECT_THROW(alongside(fail, nothing), InputError);
    EXPECT_THROW(alongside(nothing, fail), InputError);
    EXPECT_THROW(alongside(fail, fail), InputError);
  }
}

TEST(TimeLeft, IsThatOfTheCasesThatAreLeft) {
  // Ten seconds a case: of five two are done, the third has taken four.
  EXPECT_DOUBLE_EQ(secondsLeft(2, 5, 20, 4), 26);
  EXPECT_DOUBLE_EQ(secondsLeft(4, 5, 40, 0), 10);
  // A case that takes longer than the others did has nothing left that anyone knows of.
  EXPECT_DOUBLE_EQ(secondsLeft(2, 5, 20, 15), 20);
  EXPECT_DOUBLE_EQ(secondsLeft(4, 5, 40, 99), 0);
}

TEST(TimeLeft, ReadsInOneUnit) {
  EXPECT_EQ(durationText(0.3), "0 s");
  EXPECT_EQ(durationText(99), "99 s");
  EXPECT_EQ(durationText(99.6), "2 min");
  EXPECT_EQ(durationText(3000), "50 min");
  EXPECT_EQ(durationText(5969), "99 min");
  EXPECT_EQ(durationText(5971), "1.7 h");
  EXPECT_EQ(durationText(86400), "24.0 h");
}

}  // namespace
}  // namespace gnomon
