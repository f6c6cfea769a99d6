#pragma once

#include <span>
#include <string>

#include "study/judge/ranking.h"
#include "study/record/cases.h"
#include "study/record/record.h"
#include "study/record/sweep_record.h"

namespace gnomon::report {

/// Reports for the terminal, at most 100 columns wide.

/// A run: the verdict of each view, then a table of all methods for each view and light (for a view
/// with more than three lights one table), the claims with their verdicts, the error budgets, the
/// thresholds that failed, what each method costs, and the time of each stage.
/// @param colours  ANSI colours and bold face; without them the text is plain
std::string terminalReport(const study::StudyRecord& record, bool colours);

/// A sweep: the mean error rates by value, the claims over the sweep, and the thresholds that
/// failed.
std::string terminalReport(const study::SweepRecord& sweep, bool colours);

/// The ranking over all studies of a run.
std::string terminalReport(std::span<const study::StudyMeans> studies, bool colours);

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
