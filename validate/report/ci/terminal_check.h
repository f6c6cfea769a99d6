#pragma once

#include <span>
#include <string>

#include "study/record/check_record.h"

namespace gnomon::report {

/// A study's check, at most 100 columns wide: every threshold with its value, limit, margin and
/// verdict; how many references hold, and those that do not; problems, notices, and where something
/// failed the command that reproduces it, on a line of its own however long it is.
std::string checkTable(const study::CheckRecord& check, bool colours);

/// The last lines: how many gates of how many studies passed, failed, were undefined or skipped,
/// which studies did not pass, and the exit status.
std::string checkSummary(std::span<const study::CheckRecord> checks, ExitStatus status,
                         bool colours);

}  // namespace gnomon::report
