#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/shards/arguments.h"
#include "cli/shards/shard.h"

namespace gnomon::cli {

/// What a shard was asked for, and what of it is there: `shard.json` in its folder of results.
struct ShardManifest {
  /// A study of the command.
  struct Study {
    std::string file;    ///< as the command names it
    std::string name;    ///< of its folder
    std::string sha256;  ///< of its text
    bool operator==(const Study&) const = default;
  };
  /// A case of the shard.
  struct Case {
    std::string name;    ///< of its folder: NAME, or of a sweep's step NAME/VALUE
    std::string sha256;  ///< as caseHash
    bool isWhole = false;
    bool operator==(const Case&) const = default;
  };

  std::string version, commit;  ///< of the program
  Shard shard;
  Arguments arguments;  ///< without --shard
  std::vector<Study> studies;
  std::vector<Case> cases;

  /// Whether nothing of it is missing.
  [[nodiscard]] bool isWhole() const;
};

constexpr const char* manifestFile = "shard.json";

/// As JSON, schema `gnomon-shard/1`.
std::string manifestText(const ShardManifest& manifest);

/// The manifest in a folder.
/// @throws InputError naming the file where there is none, or it is none
ShardManifest readManifest(const std::filesystem::path& folder);

/// The words that a shard's results depend on: without where they go and how many threads find
/// them.
Arguments settingsOf(const ShardManifest& manifest);

/// The command that makes a shard.
std::string commandOf(const ShardManifest& manifest, const Shard& shard, const std::string& out);

}  // namespace gnomon::cli
