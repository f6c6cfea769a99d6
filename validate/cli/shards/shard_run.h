#pragma once

#include "cli/commands/run_command.h"
#include "cli/shards/shard_manifest.h"
#include "common/error.h"
#include "study/spec/sweep/sweep.h"

namespace gnomon::cli {

/// Runs the part of a command's cases that is the shard's: each case's folder is that of a run
/// without shards, and holds besides what merge reads (kept_case.h). What is over several cases (a
/// sweep's report, a ranking, claims that speak of other studies) is merge's. `out/shard.json` is
/// the manifest: it is written before the first case, and again when the shard is through.
///
/// A case that fails does not keep the others from being measured. A shard that is started again
/// with the same studies and options does only what is not whole; with others it begins anew.
/// @param request  its shard is set
/// @return pass, or the largest status of what failed and of the cases' problems
/// @throws UsageError for a study from a stream: merge could not read it again; InputError where
///   the folder holds another shard
ExitStatus runShard(const RunRequest& request);

/// The manifest's entry of a plan.
ShardManifest::Study manifestStudy(const study::StudyPlan& plan);

}  // namespace gnomon::cli
