#pragma once

#include <optional>

#include "cli/commands/run_command.h"
#include "common/error.h"

namespace gnomon::cli {

/// What `gnomon plan` was asked for.
struct PlanRequest {
  RunRequest run;
  bool json = false;
  std::optional<int> shards;  ///< also how they would share the cases
};

/// Prints the cases of a run and what each is expected to take: seconds by the clock and the peak
/// of memory, by one case that is measured (the one of median cost) or was, see calibrate. On a
/// terminal a line each up to `mostCaseLines` cases, a line a study for more; as JSON (schema
/// `gnomon-plan/1`) always all of them, with the parts of each estimate.
/// @throws as readPlans, and as runStudies for the case that is measured
ExitStatus planStudies(const PlanRequest& request);

constexpr std::size_t mostCaseLines = 50;

}  // namespace gnomon::cli
