#include "common/work_beside.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>

namespace gnomon {
namespace {

TEST(WorkBeside, GoesOnWhileItsOwnerGoesOn) {
  WorkBeside beside;
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

TEST(WorkBeside, IsOnePieceAfterTheOther) {
  WorkBeside beside;
  std::string order;
  for (const char letter : std::string("abcdefgh"))
    beside.start([&order, letter] { order += letter; });
  beside.finish();
  EXPECT_EQ(order, "abcdefgh");
}

TEST(WorkBeside, ThrowsWhatAPieceThrew) {
  WorkBeside beside;
  const auto fails = [] { throw std::runtime_error("full"); };
  beside.start(fails);
  beside.wait();
  EXPECT_THROW(beside.start([] { FAIL() << "a later piece"; }), std::runtime_error);
  beside.start(fails);
  EXPECT_THROW(beside.finish(), std::runtime_error);
  beside.finish();  // thrown once
}

TEST(WorkBeside, EndsBeforeItsOwner) {
  std::atomic<bool> isDone = false;
  {
    WorkBeside beside;
    beside.start([&] { isDone = true; });
  }
  EXPECT_TRUE(isDone);
}

}  // namespace
}  // namespace gnomon
