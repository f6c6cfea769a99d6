#pragma once

#include <tbb/global_control.h>

#include <cstddef>
#include <functional>
#include <future>
#include <optional>
#include <utility>

#include "common/progress.h"

#if defined(__SANITIZE_THREAD__)
#include <array>
#include <atomic>
#include <exception>
#include <functional>
#include <thread>
#else
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#endif

#if defined(__SANITIZE_THREAD__)
#include <future>
#else
#include <tbb/task_group.h>
#endif

namespace gnomon {

/// How many threads the process allows at once: the processors, or what --threads says.
inline std::size_t threadCount() {
  return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
}

/// Calls `body(i)` for every i in [begin, end), on all threads that the process allows. Each call
/// must write only to what belongs to its i: results then do not depend on the thread count. If one
/// throws, those not begun may be left out, and the exception (of several, any) leaves this call.
/// @param grain  indices a thread takes at once
/// @throws Cancelled where a Cancellation ends the work that this is part of
template <typename Body>
void parallelFor(std::size_t begin, std::size_t end, const Body& body, std::size_t grain = 1) {
#if defined(__SANITIZE_THREAD__)
  // ThreadSanitizer does not see how an uninstrumented TBB hands work over and would report every
  // loop. Two plain threads show it the same bodies at the same time.
  std::atomic<std::size_t> next = begin;
  std::array<std::exception_ptr, 2> thrown;
  const auto work = [&](std::exception_ptr& failure) {
    try {
      for (std::size_t first = next.fetch_add(grain); first < end; first = next.fetch_add(grain)) {
        for (std::size_t i = first; i < end && i < first + grain; ++i) body(i);
      }
    } catch (...) {
      failure = std::current_exception();
      next = end;
    }
  };
  std::thread other(work, std::ref(thrown[0]));
  work(thrown[1]);
  other.join();
  for (const std::exception_ptr& failure : thrown) {
    if (failure) std::rethrow_exception(failure);
  }
#else
  tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, grain),
                    [&body](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
                    });
  throwIfCancelled();  // then TBB has left bodies out, without a word
#endif
}

/// Calls `here()` on this thread, for work that is bound to it, and `there()` on any, at the same
/// time where the process allows another. Both have ended when it returns. If `here` throws,
/// `there` may be left out, and its exception (of two, any) leaves this call.
template <typename Here, typename There>
void alongside(const Here& here, const There& there) {
#if defined(__SANITIZE_THREAD__)
  // As in parallelFor: ThreadSanitizer does not see how TBB hands work over.
  std::future<void> other = std::async(std::launch::async, there);
  here();
  other.get();
#else
  tbb::task_group other;
  other.run(there);
  try {
    here();
  } catch (...) {
    other.cancel();
    other.wait();
    throw;
  }
  other.wait();
  throwIfCancelled();  // then `there` may have been left out
#endif
}

/// A value that is made when it is first asked for, by one thread at a time.
template <typename T>
class OnDemand {
 public:
  /// @param make  what it refers to outlives the value's making
  explicit OnDemand(std::function<T()> make) : make_(std::move(make)) {}

  [[nodiscard]] const T& get() const {
    if (!value_) value_.emplace(make_());
    return *value_;
  }

 private:
  std::function<T()> make_;
  mutable std::optional<T> value_;
};

/// Work that goes on while its owner does something else, one piece after the other.
class BackgroundWork {
 public:
  /// Starts a piece once the former has ended.
  /// @throws what that threw
  void start(std::function<void()> work) {
    finish();
    running_ = std::async(std::launch::async, std::move(work));
  }
  /// Waits; what a piece threw waits too.
  void wait() const {
    if (running_.valid()) running_.wait();
  }
  /// Waits for the last piece.
  /// @throws what it threw
  void finish() {
    if (running_.valid()) running_.get();
  }

 private:
  std::future<void> running_;  ///< which waits before it goes
};

}  // namespace gnomon
