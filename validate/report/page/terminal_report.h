#pragma once

#include <span>
#include <string>

#include "study/judge/ranking.h"
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

}  // namespace gnomon::report
