#pragma once

#include <string>
#include <vector>

#include "cli/output.h"
#include "common/error.h"

namespace gnomon::cli {

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
