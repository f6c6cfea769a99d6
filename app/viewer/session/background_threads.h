#pragma once

#include <tbb/task_arena.h>
#include <tbb/task_scheduler_observer.h>

namespace gnomon::app {

/// Makes the calling thread one that computes behind a window: of low priority, as are all threads
/// that help it, and on one core less than there are, so that drawing always finds one.
class BackgroundThread {
 public:
  BackgroundThread();
  BackgroundThread(const BackgroundThread&) = delete;
  BackgroundThread& operator=(const BackgroundThread&) = delete;
  ~BackgroundThread() = default;

  /// Runs work whose parallel loops take the background's cores.
  template <typename Work>
  void run(const Work& work) const {
    arena_.execute(work);
  }

 private:
  class LowPriority : public tbb::task_scheduler_observer {
   public:
    explicit LowPriority(tbb::task_arena& arena);
    LowPriority(const LowPriority&) = delete;
    LowPriority& operator=(const LowPriority&) = delete;
    LowPriority(LowPriority&&) = delete;
    LowPriority& operator=(LowPriority&&) = delete;
    ~LowPriority() override;
    void on_scheduler_entry(bool isWorker) override;
  };

  mutable tbb::task_arena arena_;
  LowPriority observer_;
};

}  // namespace gnomon::app
