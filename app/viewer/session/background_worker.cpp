#include "viewer/session/background_worker.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <thread>

namespace gnomon::app {

namespace {

/// On Linux the "process" of setpriority is a thread. A process without rights may lower it, never
/// raise it again: the thread keeps it.
void lowerPriority() {
  constexpr int nice = 15;
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), nice);
}

int backgroundCores() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1);
}

}  // namespace

BackgroundThread::LowPriority::LowPriority(tbb::task_arena& arena)
    : tbb::task_scheduler_observer(arena) {
  observe(true);
}

BackgroundThread::LowPriority::~LowPriority() {
  observe(false);
}

void BackgroundThread::LowPriority::on_scheduler_entry(bool isWorker) {
  if (isWorker) lowerPriority();
}

BackgroundThread::BackgroundThread() : arena_(backgroundCores()), observer_(arena_) {
  lowerPriority();
}

}  // namespace gnomon::app
