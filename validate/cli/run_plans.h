#pragma once

#include <span>
#include <vector>

#include "cli/commands/run_command.h"
#include "cli/failure.h"
#include "cli/plan_runs.h"
#include "common/error.h"
#include "study/spec/sweep/sweep.h"

namespace gnomon::cli {

/// Claims and clears the folders that a command writes to, before anything is written.
void claimFolders(const std::vector<study::StudyPlan>& plans, const RunRequest& request,
                  RunFolders& folders);

/// Measures all plans of a command, one after the other, writes their folders and their ranking,
/// and prints their tables: what runStudies says.
/// @param failures  those of the plans are added
/// @return pass, or the largest status of the failures and of the records' problems
ExitStatus measurePlans(const std::vector<study::StudyPlan>& plans, const RunRequest& request,
                        Failures& failures);

/// Prints the tables of plans whose folders are written, and writes and prints their ranking.
/// @return likewise
ExitStatus finishPlans(std::span<const PlanRecords> plans, const RunRequest& request,
                       Records& records, Failures& failures);

}  // namespace gnomon::cli
