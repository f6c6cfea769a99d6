#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/shards/shard.h"
#include "study/spec/sweep/sweep.h"

namespace gnomon::cli {

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
