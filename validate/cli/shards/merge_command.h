#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "cli/commands/run_command.h"
#include "cli/shards/arguments.h"
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

/// Writes what the run without shards would have written to the same folder: all figures and
/// pictures are those that the shards have kept, and the reports are made from them by the very
/// functions of a run. No OpenGL is needed. Studies are read again, by the names that the shards'
/// command gives them.
///
/// First everything is looked through, and nothing is written where something is amiss: a folder
/// without a manifest, a shard that is missing, doubled, not whole, of another command, version or
/// study. Each is named on a line of standard error, followed by the command that makes up for it.
/// @return as runStudies; badInput where something is amiss
/// @throws InputError and UsageError as readPlans; UsageError for an `out` that is a shard's
ExitStatus mergeShards(const MergeRequest& request);

}  // namespace gnomon::cli
