#include "cli/shards/shard_file.h"

#include <fmt/core.h>

#include "common/error.h"
#include "common/text/sha256.h"
#include "common/text/shell_quote.h"
#include "report/json/json_reader.h"
#include "study/run/scene/environment.h"

namespace gnomon::cli {
namespace fs = std::filesystem;
namespace {

using report::Json;

constexpr const char* schema = "gnomon-shard/2";

}  // namespace

std::string commandText(std::span<const std::string> arguments) {
  std::string text = "gnomon";
  for (const std::string& word : arguments) text += " " + shellQuoted(word);
  return text;
}

Arguments withoutOption(const Arguments& arguments, std::string_view name) {
  Arguments kept;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] == name) {
      ++i;  // its value
    } else if (!arguments[i].starts_with(std::string(name) + "=")) {
      kept.push_back(arguments[i]);
    }
  }
  return kept;
}

ShardFile shardFileOf(const Shard& shard, const Arguments& arguments,
                      const std::vector<study::StudyPlan>& plans) {
  ShardFile file{study::programVersion(), study::programCommit(), shard, arguments, {}};
  for (const char* option : {"--shard", "--out", "--threads"}) {
    file.arguments = withoutOption(file.arguments, option);
  }
  for (const study::StudyPlan& plan : plans) {
    file.studies.push_back(sha256(plan.steps.front().text));
  }
  return file;
}

std::string shardFileText(const ShardFile& file) {
  const Json json = {{"schema", schema},       {"gnomon_version", file.version},
                     {"commit", file.commit},  {"shard", file.shard.index},
                     {"of", file.shard.count}, {"arguments", file.arguments},
                     {"studies", file.studies}};
  // Names may hold any bytes; what is compared with them has been through here as well.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

ShardFile readShardFile(const fs::path& folder) {
  const fs::path path = folder / shardFileName;
  std::error_code failure;
  if (!fs::exists(path, failure)) {
    throw InputError(fmt::format(
        "{}: no {} found, the folder of results of a finished `gnomon run --shard` expected",
        folder.string(), shardFileName));
  }
  try {
    const Json json = report::readJson(path);
    if (json.at("schema").get<std::string>() != schema) throw InputError("another schema");
    return {json.at("gnomon_version").get<std::string>(), json.at("commit").get<std::string>(),
            parseShard(fmt::format("{}/{}", json.at("shard").get<int>(), json.at("of").get<int>())),
            json.at("arguments").get<Arguments>(), json.at("studies").get<Arguments>()};
  } catch (const std::exception& error) {
    throw InputError(
        fmt::format("{}: the file of a shard expected: {}", path.string(), error.what()));
  }
}

std::string shardCommand(const ShardFile& file, const Shard& shard, const std::string& out) {
  Arguments words = file.arguments;
  words.insert(words.end(), {"--out", out, "--shard", shardText(shard)});
  return commandText(words);
}

}  // namespace gnomon::cli
