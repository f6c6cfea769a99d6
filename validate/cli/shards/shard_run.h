#pragma once

#include "cli/commands/run_command.h"
#include "common/error.h"

namespace gnomon::cli {

/// Runs the cases of a shard, each as a study of its own: a case of a sweep has the folder
/// `out/NAME/VALUE` with all that the run of a study writes, with `metricsOnly` too. What is over
/// several cases (a sweep's files, a ranking) is merge's. `out/shard.json` is written last, unless
/// a case has failed.
/// @param request  its shard is set
/// @return as runStudies
/// @throws UsageError for a study from a stream: merge could not read it again
ExitStatus runShard(const RunRequest& request);

}  // namespace gnomon::cli
