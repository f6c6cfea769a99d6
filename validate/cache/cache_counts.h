#pragma once

#include <cstdint>

namespace gnomon::cache {

/// What was found in a cache, and what was not.
struct CacheCounts {
  std::uint64_t hits = 0;
  std::uint64_t misses = 0;   ///< damaged ones among them
  std::uint64_t damaged = 0;  ///< entries that were not as they were written, and were removed

  friend CacheCounts operator-(CacheCounts a, const CacheCounts& b) {
    return {a.hits - b.hits, a.misses - b.misses, a.damaged - b.damaged};
  }
};

}  // namespace gnomon::cache
