#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/error.h"

namespace gnomon::cli {

/// What the command line writes on standard output and standard error. Output that is lost is a
/// failure: who reads an empty table must not read exit status 0 beside it.

/// Whoever reads standard output has closed it, as `head` does: an error, of which nothing is said.
class ClosedPipe : public InputError {
 public:
  ClosedPipe() : InputError("standard output: nobody reads it any more") {}
};

/// Prepares the process before it writes anything. A stream that is closed stays without a number
/// for any file, so that no text gets into one, and writing it fails. A closed pipe (SIGPIPE) and a
/// limit of file sizes (SIGXFSZ) are errors of writing in place of signals.
void prepareStreams();

/// Writes to standard output at once. Names in the text can give GitHub's runner no command: see
/// withoutWorkflowCommands.
/// @throws InputError where it cannot be written
void printText(std::string_view text);

/// Writes one line, whatever names in it hold: see oneLine.
/// @throws InputError where it cannot be written
void printLine(std::string_view text);

/// As printText without a change: JSON, and commands that are meant.
/// @throws InputError where it cannot be written
void printUnchanged(std::string_view text);

/// Writes to standard error; what becomes of it `isErrorLost` says.
void printError(std::string_view text) noexcept;

/// Writes what libraries left in standard output's buffer.
/// @throws InputError where something on standard output could not be written
void flushOutput();

/// Whether something on standard output could not be written.
bool isOutputLost();

/// Whether something on standard error could not be written.
bool isErrorLost();

/// Refuses to write a file over one that the command reads, by whatever names, links too.
/// @param option  as typed: "--json"
/// @throws UsageError "--json mine.png: the command reads this file, another one expected"
void requireNoInput(const std::string& option, const std::filesystem::path& output,
                    std::span<const std::filesystem::path> inputs);

/// Refuses to write one file for two options.
/// @throws UsageError "--json a.png: --difference writes this file too"
void requireOther(const std::string& option, const std::filesystem::path& output,
                  const std::string& otherOption, const std::filesystem::path& other);

/// Whether standard output takes colours: a terminal that knows them, and NO_COLOR is not set.
bool coloursWanted();

/// Whether standard error is a terminal whose line can be written anew.
bool progressWanted();

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

/// What went wrong, as a status and one line.
struct Failure {
  ExitStatus status = ExitStatus::internal;
  std::string message;
};

/// The exception that is being handled: to be called inside a `catch (...)`. What is no Error is
/// internal, running out of memory included.
Failure currentFailure();

/// Writes `gnomon: MESSAGE` to standard error. Messages quote files, drivers and keys: whatever
/// they hold, an error is one line.
void printFailure(const Failure& failure);

/// Writes `gnomon: warning: TEXT` likewise.
void printWarning(const std::string& text);

/// What failed of several pieces of work that need not all succeed.
class Failures {
 public:
  /// Does a piece of work, and keeps how it failed. Output that is lost ends the whole.
  /// @return whether it has succeeded
  template <typename Work>
  bool attempt(const Work& work) {
    try {
      work();
      return true;
    } catch (...) {
      if (isOutputLost()) throw;
      all_.push_back(currentFailure());
      return false;
    }
  }

  /// Prints each, in their order.
  void print() const;
  /// The largest of their statuses; pass where there is none.
  [[nodiscard]] ExitStatus status() const;

 private:
  std::vector<Failure> all_;
};

}  // namespace gnomon::cli
