#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace gnomon {

/// One line on standard error that says which stage runs, how far it is, and how long it will take:
/// only where standard error is a terminal, and only for stages over half a second.
class TerminalProgress {
 public:
  /// @param title  opens the line
  explicit TerminalProgress(std::string title);
  TerminalProgress(const TerminalProgress&) = delete;
  TerminalProgress& operator=(const TerminalProgress&) = delete;
  /// Clears the line.
  ~TerminalProgress();

  void update(std::string_view stage, double share);

 private:
  using Clock = std::chrono::steady_clock;
  void clear();

  std::string title_;
  bool enabled_;
  bool shown_ = false;
  std::string stage_;
  Clock::time_point stageStart_;
  Clock::time_point lastShown_;
};

}  // namespace gnomon
