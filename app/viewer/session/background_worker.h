#pragma once

#include <tbb/task_arena.h>
#include <tbb/task_scheduler_observer.h>

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/progress.h"

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

/// Thrown out of a computation that nobody waits for any more.
struct Cancelled {};

/// How far a background computation is.
struct WorkStatus {
  bool busy = false;
  std::string stage;  ///< "bake"
  double share = 0;   ///< of the stage, 0 to 1
};

/// One thread that computes what was asked for last. A new request cancels the one under way; of
/// requests that wait only the newest is kept. Values go in and values come out: nothing is shared
/// but what both sides hold as const. Whatever is large and no longer needed is dropped on this
/// thread, since freeing it can take as long as a frame.
template <typename Request, typename Result>
class BackgroundWorker {
 public:
  /// What the work sees of its own job.
  class Job {
   public:
    /// A progress of a stage that throws Cancelled once the job is not wanted any more.
    [[nodiscard]] Progress progress(const std::string& stage) const {
      return [this, stage](double share) { worker_.report(number_, stage, share); };
    }
    /// Throws Cancelled if the job is not wanted any more.
    void check() const { worker_.check(number_); }
    /// Hands out a result; those that were not taken yet stay in line before it.
    void publish(Result result) const { worker_.publish(number_, std::move(result)); }

   private:
    friend class BackgroundWorker;
    Job(BackgroundWorker& worker, std::uint64_t number) : worker_(worker), number_(number) {}
    BackgroundWorker& worker_;
    std::uint64_t number_;
  };

  /// @param work  `work(request, job)` on the thread; must let Cancelled pass
  /// @param wake  called on the thread after every result
  BackgroundWorker(std::function<void(const Request&, const Job&)> work, std::function<void()> wake)
      : work_(std::move(work)), wake_(std::move(wake)), thread_([this] { loop(); }) {}
  BackgroundWorker(const BackgroundWorker&) = delete;
  BackgroundWorker& operator=(const BackgroundWorker&) = delete;
  /// Cancels what is under way and waits for the thread.
  ~BackgroundWorker() {
    {
      const std::scoped_lock lock(mutex_);
      ending_ = true;
      ++wanted_;
      waiting_.reset();
    }
    changed_.notify_all();
    thread_.join();
  }

  /// Asks for something new: results of older requests that were not taken are dropped.
  void request(Request request) {
    {
      const std::scoped_lock lock(mutex_);
      dropAll();
      waiting_ = std::move(request);
    }
    changed_.notify_all();
  }

  /// Nothing is wanted any more: results that were not taken are dropped.
  void cancel() {
    {
      const std::scoped_lock lock(mutex_);
      dropAll();
      status_ = {};
    }
    changed_.notify_all();
  }

  /// The oldest result that was not taken yet.
  std::optional<Result> take() {
    const std::scoped_lock lock(mutex_);
    if (results_.empty()) return std::nullopt;
    std::optional<Result> result(std::move(results_.front()));
    results_.erase(results_.begin());
    return result;
  }

  /// Drops a value on the worker's thread.
  template <typename Value>
  void dispose(Value value) {
    {
      const std::scoped_lock lock(mutex_);
      keepForDisposal(std::move(value));
    }
    changed_.notify_all();
  }

  [[nodiscard]] WorkStatus status() const {
    const std::scoped_lock lock(mutex_);
    return status_;
  }

 private:
  template <typename Value>
  void keepForDisposal(Value value) {
    disposed_.push_back(std::make_shared<Value>(std::move(value)));
  }

  /// Makes everything that was asked for before unwanted: the request that waits, what is under
  /// way, and results in line. What is in line always belongs to the newest request.
  void dropAll() {
    ++wanted_;
    if (waiting_) keepForDisposal(std::move(*waiting_));
    waiting_.reset();
    for (Result& result : results_) keepForDisposal(std::move(result));
    results_.clear();
  }

  void loop() {
    const BackgroundThread background;
    std::unique_lock lock(mutex_);
    while (!ending_) {
      if (!disposed_.empty()) {
        auto dropped = std::exchange(disposed_, {});
        lock.unlock();
        dropped.clear();
        lock.lock();
      } else if (waiting_) {
        Request request = std::move(*waiting_);
        waiting_.reset();
        const std::uint64_t number = wanted_;
        status_ = {true, {}, 0};
        lock.unlock();
        background.run([&] { runJob(request, number); });
        wake_();
        lock.lock();
        if (!waiting_) status_ = {};
      } else {
        changed_.wait(lock);
      }
    }
  }

  void runJob(const Request& request, std::uint64_t number) {
    try {
      work_(request, Job(*this, number));
    } catch (const Cancelled&) {
      // Somebody wants something else.
    }
  }

  void report(std::uint64_t number, const std::string& stage, double share) {
    const std::scoped_lock lock(mutex_);
    if (number != wanted_) throw Cancelled{};
    status_ = {true, stage, share};
  }

  void check(std::uint64_t number) const {
    const std::scoped_lock lock(mutex_);
    if (number != wanted_) throw Cancelled{};
  }

  void publish(std::uint64_t number, Result result) {
    {
      const std::scoped_lock lock(mutex_);
      if (number != wanted_) throw Cancelled{};
      results_.push_back(std::move(result));
    }
    wake_();
  }

  std::function<void(const Request&, const Job&)> work_;
  std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Request> waiting_;
  std::vector<Result> results_;
  std::vector<std::shared_ptr<void>> disposed_;
  WorkStatus status_;
  std::uint64_t wanted_ = 0;
  bool ending_ = false;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace gnomon::app
