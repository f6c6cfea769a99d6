#include "cli/shards/shard_manifest.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/error.h"
#include "report/json/json_reader.h"

namespace gnomon::cli {
namespace fs = std::filesystem;
namespace {

using report::Json;

constexpr const char* schema = "gnomon-shard/1";

Json jsonStudyOf(const ShardManifest::Study& study) {
  return {{"file", study.file}, {"name", study.name}, {"sha256", study.sha256}};
}

Json jsonCaseOf(const ShardManifest::Case& one) {
  return {{"name", one.name}, {"sha256", one.sha256}, {"whole", one.isWhole}};
}

ShardManifest manifestOf(const Json& json) {
  if (json.at("schema").get<std::string>() != schema) throw InputError("another schema");
  ShardManifest manifest;
  manifest.version = json.at("gnomon_version").get<std::string>();
  manifest.commit = json.at("commit").get<std::string>();
  manifest.shard =
      parseShard(fmt::format("{}/{}", json.at("shard").get<int>(), json.at("of").get<int>()));
  manifest.arguments = json.at("arguments").get<Arguments>();
  for (const Json& study : json.at("studies")) {
    manifest.studies.push_back({study.at("file").get<std::string>(),
                                study.at("name").get<std::string>(),
                                study.at("sha256").get<std::string>()});
  }
  for (const Json& one : json.at("cases")) {
    manifest.cases.push_back({one.at("name").get<std::string>(),
                              one.at("sha256").get<std::string>(), one.at("whole").get<bool>()});
  }
  return manifest;
}

}  // namespace

bool ShardManifest::isWhole() const {
  return std::all_of(cases.begin(), cases.end(), [](const Case& one) { return one.isWhole; });
}

std::string manifestText(const ShardManifest& manifest) {
  Json json = {{"schema", schema},
               {"gnomon_version", manifest.version},
               {"commit", manifest.commit},
               {"shard", manifest.shard.index},
               {"of", manifest.shard.count},
               {"whole", manifest.isWhole()},
               {"arguments", manifest.arguments},
               {"studies", Json::array()},
               {"cases", Json::array()}};
  for (const auto& study : manifest.studies) json["studies"].push_back(jsonStudyOf(study));
  for (const auto& one : manifest.cases) json["cases"].push_back(jsonCaseOf(one));
  // Names may hold any bytes; what is compared with them has been through here as well.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

ShardManifest readManifest(const fs::path& folder) {
  const fs::path file = folder / manifestFile;
  std::error_code failure;
  if (!fs::exists(file, failure)) {
    throw InputError(
        fmt::format("{}: no {} found, the folder of results of a `gnomon run --shard` expected",
                    folder.string(), manifestFile));
  }
  try {
    return manifestOf(report::readJson(file));
  } catch (const std::exception& error) {
    throw InputError(
        fmt::format("{}: the manifest of a shard expected: {}", file.string(), error.what()));
  }
}

Arguments settingsOf(const ShardManifest& manifest) {
  return withoutOption(withoutOption(manifest.arguments, "--out"), "--threads");
}

std::string commandOf(const ShardManifest& manifest, const Shard& shard, const std::string& out) {
  Arguments arguments = withOut(manifest.arguments, out);
  arguments.emplace_back("--shard");
  arguments.push_back(shardText(shard));
  return commandText(arguments);
}

}  // namespace gnomon::cli
