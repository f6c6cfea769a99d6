#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

namespace gnomon {

/// Calls `body(i)` for every i in [begin, end), on all threads that the process allows. Each call
/// must write only to what belongs to its i: results then do not depend on the thread count.
/// @param grain  indices a thread takes at once
template <typename Body>
void parallelFor(std::size_t begin, std::size_t end, const Body& body, std::size_t grain = 1) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, grain),
                    [&body](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
                    });
}

}  // namespace gnomon
