#pragma once

#include <cstddef>

#if defined(__SANITIZE_THREAD__)
#include <atomic>
#include <thread>
#else
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#endif

namespace gnomon {

/// Calls `body(i)` for every i in [begin, end), on all threads that the process allows. Each call
/// must write only to what belongs to its i: results then do not depend on the thread count.
/// @param grain  indices a thread takes at once
template <typename Body>
void parallelFor(std::size_t begin, std::size_t end, const Body& body, std::size_t grain = 1) {
#if defined(__SANITIZE_THREAD__)
  // ThreadSanitizer does not see how an uninstrumented TBB hands work over and would report every
  // loop. Two plain threads show it the same bodies at the same time.
  std::atomic<std::size_t> next = begin;
  const auto work = [&] {
    for (std::size_t first = next.fetch_add(grain); first < end; first = next.fetch_add(grain)) {
      for (std::size_t i = first; i < end && i < first + grain; ++i) body(i);
    }
  };
  std::thread other(work);
  work();
  other.join();
#else
  tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, grain),
                    [&body](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
                    });
#endif
}

}  // namespace gnomon
