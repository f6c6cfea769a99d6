#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "study/spec/sweep/sweep.h"

namespace gnomon::cli {

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

}  // namespace gnomon::cli
