#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace gnomon {

/// An array of plain values that start undefined: nothing is touched before it is written, so that
/// the thread that fills a part also gets its pages. Large ones ask for huge pages, which saves
/// most of what fresh memory costs.
template <typename T>
class RawBuffer {
 public:
  RawBuffer() = default;
  /// @throws std::bad_alloc
  explicit RawBuffer(std::size_t count) : size_(count) {
    constexpr std::size_t line = 64;
    constexpr std::size_t hugePage = std::size_t{1} << 21;
    std::size_t bytes = count * sizeof(T);
    const std::size_t alignment = bytes >= hugePage ? hugePage : line;
    bytes = (bytes + alignment - 1) / alignment * alignment;
    if (bytes == 0) return;
    data_.reset(static_cast<T*>(std::aligned_alloc(alignment, bytes)));
    if (!data_) throw std::bad_alloc();
#if defined(__linux__)
    // A hint: without it the same memory comes in small pages.
    if (alignment == hugePage) madvise(data_.get(), bytes, MADV_HUGEPAGE);
#endif
  }

  [[nodiscard]] T* data() {
    return data_.get();
  }
  [[nodiscard]] const T* data() const {
    return data_.get();
  }
  [[nodiscard]] std::size_t size() const {
    return size_;
  }
  T& operator[](std::size_t i) {
    return data_.get()[i];
  }
  const T& operator[](std::size_t i) const {
    return data_.get()[i];
  }

 private:
  struct Free {
    void operator()(T* data) const { std::free(data); }
  };
  std::unique_ptr<T, Free> data_;
  std::size_t size_ = 0;
};

}  // namespace gnomon
