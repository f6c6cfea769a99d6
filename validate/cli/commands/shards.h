#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/error.h"
#include "study/spec/sweep/sweep.h"

namespace gnomon::cli {

struct RunRequest;

/// One of the parts that the cases of a command are divided into.
struct Shard {
  int index = 1;  ///< from 1 to `count`
  int count = 1;
  bool operator==(const Shard&) const = default;
};

/// Neighbours of the list of all cases, from `begin` up to `end`.
struct CaseRange {
  std::size_t begin = 0, end = 0;
  [[nodiscard]] bool has(std::size_t place) const { return begin <= place && place < end; }
};

/// The cases of a shard, of `count` cases of all shards together: equally many, to one. Neighbours
/// of a sweep share what does not change between them.
CaseRange casesOf(const Shard& shard, std::size_t count);

constexpr int mostShards = 100'000;

/// "2/16": the second of sixteen.
std::string shardText(const Shard& shard);

/// @throws UsageError for anything else than `I/N` with 1 ≤ I ≤ N ≤ mostShards
Shard parseShard(std::string_view text);

/// The shard that the environment asks for; none where it asks for none. First of an array of
/// Slurm: SLURM_ARRAY_TASK_ID of SLURM_ARRAY_TASK_COUNT tasks, which are numbered from
/// SLURM_ARRAY_TASK_MIN (1) in steps of SLURM_ARRAY_TASK_STEP (1). Then of a runner of tests, as
/// Bazel and GoogleTest have it: TEST_SHARD_INDEX, from 0, of TEST_TOTAL_SHARDS; the file
/// TEST_SHARD_STATUS_FILE, where it is named, is then made, which tells the runner that its wish is
/// known.
/// @throws UsageError naming the variable for one that is missing beside the other or holds no
///   number that it may; InputError where the file cannot be made
std::optional<Shard> shardOfEnvironment();

/// The words of a command line behind the program's name, as they were typed.
using Arguments = std::vector<std::string>;

/// "gnomon WORD…", each word as a shell reads it back.
std::string commandText(std::span<const std::string> arguments);

/// Without an option that takes one value: `--name VALUE` or `--name=VALUE`.
Arguments withoutOption(const Arguments& arguments, std::string_view name);

/// What a shard's folder of results holds: the file `shard.json` beside the folders of its cases.
/// The shard writes it last, when all of its cases are measured.
struct ShardFile {
  std::string version, commit;  ///< of the program
  Shard shard;
  /// The command that all shards share: without --shard, --out and --threads.
  Arguments arguments;
  std::vector<std::string> studies;  ///< SHA-256 of each study's text, in the command's order
};

constexpr const char* shardFileName = "shard.json";

/// @param arguments  of the shard's `gnomon run`
/// @param plans      of all its studies; outlines do
ShardFile shardFileOf(const Shard& shard, const Arguments& arguments,
                      const std::vector<study::StudyPlan>& plans);

/// As JSON, schema `gnomon-shard/2`.
std::string shardFileText(const ShardFile& file);

/// The file in a shard's folder of results.
/// @throws InputError where there is none, or it is damaged
ShardFile readShardFile(const std::filesystem::path& folder);

/// The command that makes another shard of the same run.
std::string shardCommand(const ShardFile& file, const Shard& shard, const std::string& out);

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
