#include "cli/shards/merge_command.h"

#include <fmt/core.h>

#include <memory>
#include <string>
#include <system_error>
#include <utility>

#include "cli/commands/cache_command.h"
#include "cli/commands/run_command.h"
#include "cli/output.h"
#include "cli/plan_runs.h"
#include "cli/shards/shard.h"
#include "cli/study_plans.h"
#include "common/files/atomic_file.h"
#include "common/files/input_file.h"
#include "report/json/summary_json.h"
#include "study/judge/claims.h"
#include "study/run/scene/environment.h"
#include "study/spec/resolved_study.h"

namespace gnomon::cli {

namespace fs = std::filesystem;
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

namespace fs = std::filesystem;
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
