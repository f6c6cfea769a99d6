#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace gnomon::app {

/// How long frames take, from the moment that input is read until the picture is handed over.
class FrameLog {
 public:
  void begin() { begin_ = Clock::now(); }
  /// @param drawn  whether the frame drew a pane anew: those that did not do not count
  void end(bool drawn);

  [[nodiscard]] double lastMilliseconds() const { return last_; }
  [[nodiscard]] double longestMilliseconds() const { return longest_; }
  /// Mean over all that count.
  [[nodiscard]] double meanMilliseconds() const;
  /// "frames: 120 drawn, mean 21.3 ms (47 a second), longest 80.2 ms".
  [[nodiscard]] std::string text() const;

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_ = Clock::now();
  double last_ = 0;
  double longest_ = 0;
  double total_ = 0;
  std::size_t count_ = 0;
};

}  // namespace gnomon::app
