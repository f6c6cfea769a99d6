#pragma once

#include <vector>

#include "cache/cache.h"
#include "cli/case_source.h"
#include "cli/commands/run_command.h"
#include "common/error.h"
#include "study/record/record.h"
#include "study/spec/sweep/sweep.h"

namespace gnomon::cli {

/// Runs all plans of a command, one after the other, from a source of their cases, writes their
/// folders and their ranking, and prints their tables: what runStudies says.
/// @return pass, or the largest status of the plans that failed and of the records' problems
ExitStatus runPlans(const std::vector<study::StudyPlan>& plans, CaseSource& cases,
                    const RunRequest& request, cache::Cache& cache);

/// A run judges no gate; a method that the driver did not let it measure is a problem.
/// @return the largest status of the records' problems
ExitStatus worstProblem(const std::vector<study::StudyRecord>& records);

}  // namespace gnomon::cli
