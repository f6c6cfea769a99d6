#include "common/alongside.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "common/error.h"

namespace gnomon {
namespace {

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

}  // namespace
}  // namespace gnomon
