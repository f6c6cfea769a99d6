#pragma once

#include <tbb/task_group.h>

namespace gnomon {

/// Thrown inside work that a Cancellation ends.
struct Cancelled {};

/// Lets one thread end the work of another. Everything that the work does by `parallelFor` ends, at
/// any depth; long work without a loop of that kind calls `throwIfCancelled` now and then.
class Cancellation {
 public:
  /// Does work on this thread, once.
  /// @throws Cancelled where `cancel` ended it; else what the work throws
  template <typename Work>
  void run(const Work& work) {
    tbb::task_group group(context_);
    if (group.run_and_wait([&] { work(); }) == tbb::canceled) throw Cancelled();
  }

  /// From any thread, before, during or after `run`.
  void cancel() { context_.cancel_group_execution(); }

 private:
  tbb::task_group_context context_;
};

/// Whether a Cancellation ends the work that this thread does.
inline bool isCancelled() {
  return tbb::is_current_task_group_canceling();
}

inline void throwIfCancelled() {
  if (isCancelled()) throw Cancelled();
}

}  // namespace gnomon
