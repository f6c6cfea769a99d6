#include "cli/shards/shard.h"

#include <fmt/core.h>

#include <charconv>
#include <cstdlib>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "common/text/sha256.h"
#include "common/text/words.h"
#include "report/json/json_values.h"
#include "study/run/scene/environment.h"

namespace gnomon::cli {

namespace {

/// A whole number and nothing else.
std::optional<int> numberIn(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// The text of a variable; none where it is not set or empty.
std::optional<std::string> variable(const char* name) {
  const char* value = std::getenv(name);
  if (value == nullptr || *value == '\0') return std::nullopt;
  return value;
}

/// A variable's number; `otherwise` where it is not set.
int numberOf(const char* name, int least, int most, std::optional<int> otherwise = {}) {
  const auto text = variable(name);
  if (!text && otherwise) return *otherwise;
  const std::optional<int> number = text ? numberIn(*text) : std::nullopt;
  if (number && least <= *number && *number <= most) return *number;
  throw UsageError(fmt::format("{}: {} found, a whole number from {} to {} expected", name,
                               text ? "\"" + *text + "\"" : "nothing", least, most));
}

Shard shardOfSlurm() {
  constexpr const char* task = "SLURM_ARRAY_TASK_ID";
  constexpr int mostTasks = 1'000'000'000;
  const int count = numberOf("SLURM_ARRAY_TASK_COUNT", 1, mostShards);
  const int least = numberOf("SLURM_ARRAY_TASK_MIN", 0, mostTasks, 1);
  const int step = numberOf("SLURM_ARRAY_TASK_STEP", 1, mostTasks, 1);
  const int index = numberOf(task, 0, mostTasks);
  const int place = (index - least) / step;
  if (index < least || (index - least) % step != 0 || place >= count) {
    throw UsageError(fmt::format(
        "{}: {} found, one of {} numbers from {} in steps of {} expected: an array whose tasks are "
        "not evenly numbered needs --shard",
        task, index, count, least, step));
  }
  return {place + 1, count};
}

Shard shardOfTests() {
  const int count = numberOf("TEST_TOTAL_SHARDS", 1, mostShards);
  const int index = numberOf("TEST_SHARD_INDEX", 0, count - 1);
  if (const auto file = variable("TEST_SHARD_STATUS_FILE")) writeTextAtomically(*file, "");
  return {index + 1, count};
}

}  // namespace

CaseRange casesOf(const Shard& shard, std::size_t count) {
  const auto index = static_cast<std::size_t>(shard.index);
  const auto shards = static_cast<std::size_t>(shard.count);
  return {(index - 1) * count / shards, index * count / shards};
}

std::string shardText(const Shard& shard) {
  return fmt::format("{}/{}", shard.index, shard.count);
}

Shard parseShard(std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash != std::string_view::npos) {
    const auto index = numberIn(text.substr(0, slash));
    const auto count = numberIn(text.substr(slash + 1));
    if (index && count && 1 <= *index && *index <= *count && *count <= mostShards) {
      return {*index, *count};
    }
  }
  throw UsageError(fmt::format("--shard: \"{}\" found, I/N expected with 1 ≤ I ≤ N ≤ {}, as 2/16",
                               text, mostShards));
}

std::optional<Shard> shardOfEnvironment() {
  if (variable("SLURM_ARRAY_TASK_ID") || variable("SLURM_ARRAY_TASK_COUNT")) return shardOfSlurm();
  if (variable("TEST_SHARD_INDEX") || variable("TEST_TOTAL_SHARDS")) return shardOfTests();
  return std::nullopt;
}

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
