#pragma once

#include <tbb/global_control.h>

#include <cstddef>

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

}  // namespace gnomon
