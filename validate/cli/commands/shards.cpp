#include "cli/commands/shards.h"

#include <fmt/core.h>

#include <charconv>
#include <cstdlib>
#include <memory>
#include <system_error>
#include <utility>

#include "cli/commands/cache_command.h"
#include "cli/commands/run_command.h"
#include "cli/output.h"
#include "cli/plan_runs.h"
#include "cli/study_plans.h"
#include "common/files/atomic_file.h"
#include "common/files/input_file.h"
#include "common/text.h"
#include "report/json/json_values.h"
#include "report/json/summary_json.h"
#include "study/judge/claims.h"
#include "study/run/scene/environment.h"
#include "study/spec/resolved_study.h"

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

namespace {

struct ShardFolder {
  fs::path path;
  ShardFile file;
};

std::string nameOf(const ShardFolder& shard) {
  return fmt::format("{}: shard {}", shard.path.string(), shardText(shard.file.shard));
}

void refuseShardAsOut(const MergeRequest& request) {
  for (const fs::path& shard : request.shards) {
    std::error_code failure;
    if (!fs::equivalent(shard, request.out, failure)) continue;
    throw UsageError(fmt::format("--out: {} is the folder of a shard, another folder expected",
                                 request.out.string()));
  }
}

std::string programText(const std::string& version, const std::string& commit) {
  return commit.empty() ? version : version + " " + commit;
}

/// Checks that a shard is of this program and of the same run as the first.
void requireSame(const ShardFolder& shard, const ShardFolder& first) {
  const auto refuse = [&](const std::string& found, const std::string& expected) {
    throw InputError(fmt::format("{} is {}, {} expected", nameOf(shard), found, expected));
  };
  const std::string own = programText(study::programVersion(), study::programCommit());
  const std::string its = programText(shard.file.version, shard.file.commit);
  if (its != own) refuse("by Gnomon " + its, "by " + own);
  const std::string as = ", as " + first.path.string() + " is,";
  if (shard.file.shard.count != first.file.shard.count) {
    refuse(fmt::format("one of {} shards", shard.file.shard.count),
           fmt::format("of {}{}", first.file.shard.count, as));
  }
  if (shard.file.arguments != first.file.arguments) {
    refuse(fmt::format("of `{}`", commandText(shard.file.arguments)),
           fmt::format("of `{}`{}", commandText(first.file.arguments), as));
  }
}

/// Where a shard that is missing may go: beside another one.
fs::path placeOf(const Shard& shard, const fs::path& other) {
  fs::path beside = other.lexically_normal();
  if (!beside.has_filename()) beside = beside.parent_path();  // a slash at the end
  return beside.parent_path() / fmt::format("shard-{}-of-{}", shard.index, shard.count);
}

/// All shards of a run in their order.
std::vector<ShardFolder> readShards(const std::vector<fs::path>& folders) {
  std::vector<ShardFolder> given;
  given.reserve(folders.size());
  for (const fs::path& folder : folders) given.push_back({folder, readShardFile(folder)});
  const int count = given.front().file.shard.count;
  std::vector<ShardFolder> shards(static_cast<std::size_t>(count));
  for (const ShardFolder& shard : given) {
    requireSame(shard, given.front());
    ShardFolder& place = shards.at(static_cast<std::size_t>(shard.file.shard.index - 1));
    if (!place.path.empty()) {
      throw InputError(
          fmt::format("{} is there twice, in {} too", nameOf(shard), place.path.string()));
    }
    place = shard;
  }
  for (int index = 1; index <= count; ++index) {
    if (!shards[static_cast<std::size_t>(index - 1)].path.empty()) continue;
    const Shard missing{index, count};
    const std::string out = placeOf(missing, folders.front()).string();
    throw InputError(fmt::format("shard {} is missing: {}", shardText(missing),
                                 shardCommand(given.front().file, missing, out)));
  }
  return shards;
}

void requireStudies(const ShardFolder& shard, const std::vector<study::StudyPlan>& plans) {
  const ShardFile now = shardFileOf(shard.file.shard, shard.file.arguments, plans);
  for (std::size_t i = 0; i < plans.size(); ++i) {
    if (i < shard.file.studies.size() && shard.file.studies[i] == now.studies[i]) continue;
    throw InputError(fmt::format("{} is of another text of {}: {}", nameOf(shard),
                                 plans[i].steps.front().file.string(),
                                 shardCommand(shard.file, shard.file.shard, shard.path.string())));
  }
}

/// The record of a case, from the summary that its shard has written.
study::StudyRecord readCase(const ShardFolder& shard, const study::StudySpec& step) {
  const fs::path folder = shard.path / step.name;
  study::StudyRecord record = report::readSummary(folder / "summary.json");
  const auto hashesOf = [](const std::vector<study::InputRecord>& inputs) {
    std::vector<std::string> hashes;
    hashes.reserve(inputs.size());
    for (const study::InputRecord& input : inputs) hashes.push_back(input.sha256);
    return hashes;
  };
  if (hashesOf(record.reproduction.inputs) != hashesOf(study::studyInputs(step, folder))) {
    throw InputError(fmt::format("{} is of other files of {}: {}", nameOf(shard), step.name,
                                 shardCommand(shard.file, shard.file.shard, shard.path.string())));
  }
  record.atlasViews = study::atlasViewsOf(step);
  record.claims = study::judgeClaims(step.claims, record);
  return record;
}

/// The shard that has measured each case.
std::vector<const ShardFolder*> shardsOfCases(const std::vector<ShardFolder>& shards,
                                              std::size_t count) {
  std::vector<const ShardFolder*> of(count);
  for (const ShardFolder& shard : shards) {
    const CaseRange cases = casesOf(shard.file.shard, count);
    for (std::size_t i = cases.begin; i < cases.end; ++i) of[i] = &shard;
  }
  return of;
}

void copyFolder(const fs::path& from, report::RunFolder& folder) {
  const report::RunFolder measured(from, studyFolderKind);
  for (const std::string& name : measured.names()) {
    if (name != studyFolderKind.index) folder.write(name, readFile(from / name));
  }
  folder.finish(readFile(from / studyFolderKind.index));
}

}  // namespace

ExitStatus mergeShards(const MergeRequest& request) {
  refuseShardAsOut(request);
  const std::vector<ShardFolder> shards = readShards(request.shards);
  Arguments arguments = shards.front().file.arguments;
  if (request.out != RunRequest().out) {
    arguments.insert(arguments.end(), {"--out", request.out.string()});
  }
  RunRequest run = request.readRun(arguments);
  run.command = commandText(arguments);
  const std::vector<study::StudyPlan> plans = readPlans(run.studies, run.options);
  for (const ShardFolder& shard : shards) requireStudies(shard, plans);

  const std::vector<const ShardFolder*> shardOf = shardsOfCases(shards, caseCount(plans));
  Records records;
  std::vector<PlanRecords> parts;
  for (const study::StudyPlan& plan : plans) {
    parts.push_back({&plan, records.all.size()});
    for (const study::StudySpec& step : plan.steps) {
      const ShardFolder& shard = *shardOf[records.all.size()];
      records.all.push_back(inStudy(step, [&] { return readCase(shard, step); }));
    }
  }

  if (!run.metricsOnly) requirePlots();
  const std::unique_ptr<cache::Cache> cache = openCache(run.noCache || request.noCache);
  claimFolders(plans, run, records.folders);
  Failures failures;
  for (const PlanRecords& part : parts) {
    for (std::size_t i = 0; i < part.plan->steps.size(); ++i) {
      const std::string& name = part.plan->steps[i].name;
      if (!records.folders.holds(name)) continue;
      copyFolder(shardOf[part.first + i]->path / name, records.folders.of(name));
    }
    if (part.plan->sweep) writeSweep(part, run, *cache, records);
  }
  return finishPlans(parts, run, records, failures);
}

namespace {

void refuseStreams(const RunRequest& request) {
  for (const fs::path& study : request.studies) {
    if (!isGivenStream(study)) continue;
    throw UsageError(fmt::format(
        "--shard: the study {} is a stream; a file expected, which merge can read again",
        study.string()));
  }
}

/// The cases of a shard, each as a plan of its own.
std::vector<study::StudyPlan> readCases(const RunRequest& request,
                                        const std::vector<study::StudyPlan>& outlines) {
  const CaseRange own = casesOf(*request.shard, caseCount(outlines));
  std::vector<study::StudyPlan> cases;
  std::size_t first = 0;  // of the study's, among all cases
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    const auto isOwn = [&](std::size_t step) { return own.has(first + step); };
    bool isAny = false;
    for (std::size_t s = 0; s < outlines[i].steps.size(); ++s) isAny = isAny || isOwn(s);
    if (isAny) {
      study::StudyPlan plan = study::readStudyPlan(request.studies[i], request.options, isOwn);
      for (study::StudySpec& step : plan.steps) {
        study::StudyPlan one{step.name, step.title, step.source, std::nullopt, {}};
        one.steps.push_back(std::move(step));
        cases.push_back(std::move(one));
      }
    }
    first += outlines[i].steps.size();
  }
  return cases;
}

}  // namespace

ExitStatus runShard(const RunRequest& request) {
  refuseStreams(request);
  const std::vector<study::StudyPlan> outlines = readOutlines(request.studies, request.options);
  requirePaperMethods(request.paper, outlines);
  const ShardFile file = shardFileOf(*request.shard, request.arguments, outlines);
  RunRequest run = request;
  run.command = commandText(file.arguments);
  const std::vector<study::StudyPlan> cases = readCases(request, outlines);
  const fs::path path = request.out / shardFileName;
  std::error_code ignored;  // which writing it tells too
  fs::create_directories(request.out, ignored);
  fs::remove(path, ignored);
  Failures failures;
  const ExitStatus status = cases.empty() ? ExitStatus::pass : measurePlans(cases, run, failures);
  if (failures.status() == ExitStatus::pass) writeTextAtomically(path, shardFileText(file));
  return status;
}

}  // namespace gnomon::cli
