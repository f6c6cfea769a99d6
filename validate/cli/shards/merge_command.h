#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "cli/commands/run_command.h"
#include "cli/shards/shard.h"
#include "common/error.h"

namespace gnomon::cli {

/// What `gnomon merge` was asked for.
struct MergeRequest {
  std::vector<std::filesystem::path>
      shards;  ///< the folders of results of all shards, in any order
  std::filesystem::path out = "out";
  bool noCache = false;
  /// Reads the words of a `gnomon run` as the command line does.
  std::function<RunRequest(const Arguments& arguments)> readRun;
};

/// Puts the shards of a run together: copies the folders of their cases, reads the records in their
/// `summary.json`, and writes from these what is over several cases (a sweep's files, a ranking,
/// a suite's statistics) by the functions of a run. With `--metrics-only` every file is the same,
/// byte for byte, as that of the run without shards. No OpenGL is needed. Studies are read again,
/// by the names that the shards' command gives them.
/// @return as runStudies
/// @throws InputError, before anything is written, for a shard that is missing, with the command
///   that makes it; for one that is there twice, is not finished, or is of another command, version
///   or study; as readPlans. UsageError for an `out` that is a shard's
ExitStatus mergeShards(const MergeRequest& request);

/// Runs the cases of a shard, each as a study of its own: a case of a sweep has the folder
/// `out/NAME/VALUE` with all that the run of a study writes, with `metricsOnly` too. What is over
/// several cases (a sweep's files, a ranking) is merge's. `out/shard.json` is written last, unless
/// a case has failed.
/// @param request  its shard is set
/// @return as runStudies
/// @throws UsageError for a study from a stream: merge could not read it again
ExitStatus runShard(const RunRequest& request);

}  // namespace gnomon::cli
