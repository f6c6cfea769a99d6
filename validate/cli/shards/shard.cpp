#include "cli/shards/shard.h"

#include <fmt/core.h>

#include <charconv>
#include <cstdlib>

#include "common/error.h"
#include "common/files/atomic_file.h"

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

}  // namespace gnomon::cli
