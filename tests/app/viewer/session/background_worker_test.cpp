#include "viewer/session/background_worker.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace gnomon::app {
namespace {

using Worker = BackgroundWorker<int, int>;

template <typename Condition>
bool comesTrue(const Condition& condition) {
  for (int i = 0; i < 2000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

int resultOf(Worker& worker) {
  std::optional<int> result;
  comesTrue([&] { return (result = worker.take()).has_value(); });
  return result.value_or(-1);
}

TEST(BackgroundWorker, ComputesWhatWasAskedForLast) {
  Worker worker([](const int& request, const Worker::Job& job) { job.publish(request * request); },
                [] {});
  worker.request(3);
  EXPECT_EQ(resultOf(worker), 9);
  worker.request(4);
  EXPECT_EQ(resultOf(worker), 16);
  EXPECT_FALSE(worker.take());
}

TEST(BackgroundWorker, ANewRequestCancelsTheOneUnderWay) {
  std::atomic<int> cancelled = 0;
  const auto endless = [&](const int& request, const Worker::Job& job) {
    if (request == 2) return job.publish(2);
    try {
      const Progress progress = job.progress("endless");
      while (true) {
        progress(0.5);
        std::this_thread::yield();
      }
    } catch (const Cancelled&) {
      ++cancelled;
      throw;
    }
  };
  Worker worker(endless, [] {});
  worker.request(1);
  ASSERT_TRUE(comesTrue([&] { return worker.status().stage == "endless"; }));
  EXPECT_TRUE(worker.status().busy);
  EXPECT_EQ(worker.status().share, 0.5);
  worker.request(2);
  EXPECT_EQ(resultOf(worker), 2);
  EXPECT_EQ(cancelled, 1);
}

TEST(BackgroundWorker, ResultsOfOlderRequestsAreNotTaken) {
  std::atomic<int> published = 0;
  Worker worker(
      [&](const int& request, const Worker::Job& job) {
        job.publish(request);
        ++published;
      },
      [] {});
  worker.request(1);
  ASSERT_TRUE(comesTrue([&] { return published == 1; }));
  worker.request(2);
  EXPECT_EQ(resultOf(worker), 2);
  EXPECT_FALSE(worker.take());
}

TEST(BackgroundWorker, ResultsOfACancelledRequestAreNotTaken) {
  std::atomic<int> published = 0;
  Worker worker(
      [&](const int& request, const Worker::Job& job) {
        job.publish(request);
        ++published;
      },
      [] {});
  worker.request(1);
  ASSERT_TRUE(comesTrue([&] { return published == 1; }));
  worker.cancel();
  EXPECT_FALSE(worker.take());
  worker.request(2);
  EXPECT_EQ(resultOf(worker), 2);
}

TEST(BackgroundWorker, EndsDuringAComputation) {
  std::atomic<bool> ended = false;
  {
    Worker worker(
        [&](const int&, const Worker::Job& job) {
          try {
            while (true) job.check();
          } catch (const Cancelled&) {
            ended = true;
            throw;
          }
        },
        [] {});
    worker.request(1);
    ASSERT_TRUE(comesTrue([&] { return worker.status().busy; }));
  }
  EXPECT_TRUE(ended);
}

/// Remembers which thread dropped it.
struct Dropped {
  explicit Dropped(std::atomic<std::thread::id>& place) : where(&place) {}
  Dropped(Dropped&& other) noexcept : where(std::exchange(other.where, nullptr)) {}
  Dropped& operator=(Dropped&&) = delete;
  Dropped(const Dropped&) = delete;
  Dropped& operator=(const Dropped&) = delete;
  ~Dropped() {
    if (where != nullptr) *where = std::this_thread::get_id();
  }
  std::atomic<std::thread::id>* where;
};

TEST(BackgroundWorker, DropsValuesOnItsOwnThread) {
  std::atomic<std::thread::id> dropper{};
  Worker worker([](const int&, const Worker::Job&) {}, [] {});
  worker.dispose(Dropped(dropper));
  ASSERT_TRUE(comesTrue([&] { return dropper.load() != std::thread::id(); }));
  EXPECT_NE(dropper.load(), std::this_thread::get_id());
}

}  // namespace
}  // namespace gnomon::app
