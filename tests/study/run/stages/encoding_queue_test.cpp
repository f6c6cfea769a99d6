#include "study/run/stages/encoding_queue.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace gnomon::study {
namespace {

using testing::ElementsAre;

TEST(EncodingQueue, DoesWhatFollowsInOrderOnceAllIsEncoded) {
  StageClock clock({});
  EncodingQueue queue(clock);
  std::atomic<int> encoded = 0;
  std::vector<int> order;
  std::vector<std::thread::id> threads;
  for (int piece = 0; piece < 3; ++piece) {
    queue.add({[&] { ++encoded; }, [&] { ++encoded; }}, [&, piece] {
      EXPECT_EQ(encoded, 6);
      order.push_back(piece);
      threads.push_back(std::this_thread::get_id());
    });
  }
  EXPECT_TRUE(order.empty());
  queue.finish();
  EXPECT_THAT(order, ElementsAre(0, 1, 2));
  EXPECT_THAT(threads, testing::Each(std::this_thread::get_id()));
  queue.finish();
  EXPECT_EQ(order.size(), 3U);
  ASSERT_EQ(clock.timings().size(), 1U);
  EXPECT_EQ(clock.timings().front().stage, "writing");
}

TEST(EncodingQueue, DoesNotLetMuchWait) {
  StageClock clock({});
  EncodingQueue queue(clock);
  int done = 0;
  queue.add(
      {}, [&] { ++done; }, 60'000'000);
  EXPECT_EQ(done, 0);
  queue.add(
      {}, [&] { ++done; }, 60'000'000);
  EXPECT_EQ(done, 2);
}

}  // namespace
}  // namespace gnomon::study
