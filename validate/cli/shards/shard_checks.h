#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "cli/shards/kept_case.h"
#include "cli/shards/shard_manifest.h"
#include "study/spec/sweep/sweep.h"

namespace gnomon::cli {

/// A shard's folder of results, and what it says of itself.
struct ShardFolder {
  std::filesystem::path path;
  ShardManifest manifest;
};

/// What keeps shards from being merged.
struct Defect {
  std::string what;     ///< one line, which names the shard
  std::string command;  ///< that makes up for it; empty where none can
};

/// Reads the manifests of all folders; those that have none are defects.
std::vector<ShardFolder> readShards(const std::vector<std::filesystem::path>& folders,
                                    std::vector<Defect>& defects);

/// The shard whose command and number of shards most of the others have too; the first of equals.
/// @param shards  at least one
const ShardManifest& commonManifest(const std::vector<ShardFolder>& shards);

/// Finds the shards that are of another command, number of shards or version than `common`, that
/// are there twice, and that are missing.
/// @param merge  the command without its folders, for the case that one of them is to be left out
/// @return those that are of use, each once, in the order of their numbers
std::vector<ShardFolder> checkedShards(const std::vector<ShardFolder>& shards,
                                       const ShardManifest& common, const std::string& out,
                                       std::vector<Defect>& defects);

/// A whole case, and the folder that it lies in.
struct FoundCase {
  std::filesystem::path folder;
  KeptCase kept;
};

/// Finds all cases of the studies in the shards; those that are of another text of a study, have
/// other cases, or are not whole, are defects.
/// @return by their names
std::map<std::string, FoundCase> findCases(const std::vector<ShardFolder>& shards,
                                           const ShardManifest& common,
                                           const std::vector<study::StudyPlan>& plans,
                                           std::vector<Defect>& defects);

}  // namespace gnomon::cli
