#pragma once

#include <functional>
#include <optional>
#include <utility>

#include "common/progress.h"

#if defined(__SANITIZE_THREAD__)
#include <future>
#else
#include <tbb/task_group.h>
#endif

namespace gnomon {

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

}  // namespace gnomon
