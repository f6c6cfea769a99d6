#pragma once

#include <cstddef>
#include <cstdlib>
#include <limits>
#include <new>
#include <utility>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace gnomon {

/// Memory for large arrays of plain values: aligned to cache lines, in huge pages where that is
/// possible, which saves most of what fresh memory costs. Values that are given no value start
/// undefined.
template <typename T>
struct RawAllocator {
  using value_type = T;

  RawAllocator() = default;
  template <typename U>
  RawAllocator(const RawAllocator<U>&) {}

  /// @throws std::bad_alloc
  T* allocate(std::size_t count) {
    constexpr std::size_t line = 64;
    constexpr std::size_t hugePage = std::size_t{1} << 21;
    if (count > std::numeric_limits<std::ptrdiff_t>::max() / sizeof(T)) throw std::bad_alloc();
    std::size_t bytes = count * sizeof(T);
    const std::size_t alignment = bytes >= hugePage ? hugePage : line;
    bytes = (bytes + alignment - 1) / alignment * alignment;
    T* data = static_cast<T*>(std::aligned_alloc(alignment, bytes));
    if (!data) throw std::bad_alloc();
#if defined(__linux__)
    // A hint: without it the same memory comes in small pages.
    if (alignment == hugePage) madvise(data, bytes, MADV_HUGEPAGE);
#endif
    return data;
  }
  void deallocate(T* data, std::size_t) {
    std::free(data);
  }

  template <typename U>
  void construct(U* value) {
    ::new (static_cast<void*>(value)) U;
  }
  template <typename U, typename... Arguments>
  void construct(U* value, Arguments&&... arguments) {
    ::new (static_cast<void*>(value)) U(std::forward<Arguments>(arguments)...);
  }

  bool operator==(const RawAllocator&) const {
    return true;
  }
};

/// A vector whose new values start undefined: nothing is touched before it is written, so that the
/// thread that fills a part also gets its pages.
template <typename T>
using RawVector = std::vector<T, RawAllocator<T>>;

}  // namespace gnomon
