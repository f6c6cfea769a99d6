#pragma once

#include <functional>
#include <future>
#include <utility>

namespace gnomon {

/// Work that goes on while its owner does something else, one piece after the other.
class WorkBeside {
 public:
  /// Starts a piece once the former has ended.
  /// @throws what that threw
  void start(std::function<void()> work) {
    finish();
    running_ = std::async(std::launch::async, std::move(work));
  }
  /// Waits; what a piece threw waits too.
  void wait() const {
    if (running_.valid()) running_.wait();
  }
  /// Waits for the last piece.
  /// @throws what it threw
  void finish() {
    if (running_.valid()) running_.get();
  }

 private:
  std::future<void> running_;  ///< which waits before it goes
};

}  // namespace gnomon
