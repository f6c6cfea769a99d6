#pragma once

#include <tbb/task_group.h>

#include <cstddef>
#include <functional>
#include <mutex>
#include <string>

namespace gnomon {

/// Receives the share of a long computation that is done, from 0 to 1. It may be called from any
/// thread, but never from two at once. An empty function means that nobody is watching.
///
/// It may throw: that cancels the computation. What has begun is finished, no more than a row or a
/// face on every thread; the rest is left undone, and the exception leaves the call to the
/// computation.
using Progress = std::function<void(double share)>;

/// Tells a Progress how many of a known number of parts are done, from any thread.
class CountedProgress {
 public:
  /// @param progress  outlives this
  /// @param parts     in all, at least one
  CountedProgress(const Progress& progress, std::size_t parts)
      : progress_(progress), parts_(parts) {}

  /// One part more is done. Throws what the Progress throws.
  void advance() {
    if (!progress_) return;
    const std::scoped_lock lock(reporting_);
    progress_(static_cast<double>(++done_) / static_cast<double>(parts_));
  }

 private:
  const Progress& progress_;
  std::size_t parts_;
  std::size_t done_ = 0;
  std::mutex reporting_;
};

/// The seconds that are left when `done` of `cases` took `elapsed` seconds, and the next one has
/// taken `current` seconds so far: as if each took as long as those did on average.
/// @param done  from 1, below `cases`
double secondsLeft(std::size_t done, std::size_t cases, double elapsed, double current);

/// A duration in its largest sensible unit: "45 s", "12 min", "3.4 h".
std::string durationText(double seconds);

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
