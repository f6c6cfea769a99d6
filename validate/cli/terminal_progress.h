#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace gnomon::cli {

/// One line on standard error that says which stage runs, how far it is, and how long it will take:
/// only where standard error is a terminal, and only for stages over half a second.
///
/// Of several cases it says which one runs, and the time left for all of them: those that are left
/// take as long as those that are done did on average.
class TerminalProgress {
 public:
  /// @param title  opens the line
  /// @param cases  that beginCase will be called for
  explicit TerminalProgress(std::string title, std::size_t cases = 1);
  TerminalProgress(const TerminalProgress&) = delete;
  TerminalProgress& operator=(const TerminalProgress&) = delete;
  /// Clears the line.
  ~TerminalProgress();

  /// The next case begins, under a title of its own.
  void beginCase(std::string title);
  void update(std::string_view stage, double share);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  [[nodiscard]] std::string leftText(double share, Clock::time_point now) const;

  std::size_t cases_;
  std::size_t current_ = 0;  ///< from 1, once a case has begun
  Clock::time_point start_, caseStart_;
  std::string title_;
  bool enabled_;
  bool shown_ = false;
  std::string stage_;
  Clock::time_point stageStart_;
  Clock::time_point lastShown_;
};

}  // namespace gnomon::cli
