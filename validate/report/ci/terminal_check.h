#pragma once

#include <span>
#include <string>

#include "study/record/cases.h"

namespace gnomon::report {

/// A study's check, at most 100 columns wide: first every gate that does not hold, whole, and the
/// command that reproduces it, on a line of its own however long it is; then every other threshold
/// with its value, limit, margin and verdict, and how many references hold. Problems are only
/// counted: printFailure tells them.
std::string checkTable(const study::CheckRecord& check, bool colours);

/// What the checks' readers may want to change, once all faults are told: limits that could be
/// tightened, notices of runs. Empty where there is none.
std::string checkNotices(std::span<const study::CheckRecord> checks);

/// The last lines: how many gates of how many studies passed, failed, were undefined or skipped,
/// which studies did not pass, and the exit status.
std::string checkSummary(std::span<const study::CheckRecord> checks, ExitStatus status,
                         bool colours);

}  // namespace gnomon::report
