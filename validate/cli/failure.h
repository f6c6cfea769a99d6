#pragma once

#include <string>

#include "common/error.h"

namespace gnomon {

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

}  // namespace gnomon
