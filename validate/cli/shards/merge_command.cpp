#include "cli/shards/merge_command.h"

#include <fmt/core.h>

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "cli/case_source.h"
#include "cli/commands/cache_command.h"
#include "cli/failure.h"
#include "cli/plan_runs.h"
#include "cli/run_plans.h"
#include "cli/shards/shard_checks.h"
#include "cli/study_plans.h"
#include "report/ci/github_annotations.h"
#include "report/plots/gnuplot.h"

namespace gnomon::cli {
namespace fs = std::filesystem;
namespace {

/// Takes the cases from what shards have kept: each once.
class KeptCases final : public CaseSource {
 public:
  explicit KeptCases(std::map<std::string, FoundCase> cases) : cases_(std::move(cases)) {}

  void prepare(const study::StudySpec&) override {}

  study::StudyRecord measure(const study::StudySpec& study, report::RunFolder& folder) override {
    FoundCase& found = cases_.at(study.name);
    for (const KeptFile& file : found.kept.files) {
      folder.write(file.name, readKept(found.folder, file));
    }
    return std::move(found.kept.record);
  }

  study::StudyRecord measureFigures(const study::StudySpec& study) override {
    return std::move(cases_.at(study.name).kept.record);
  }

 private:
  std::map<std::string, FoundCase> cases_;
};

void refuseShardAsOut(const MergeRequest& request) {
  for (const fs::path& shard : request.shards) {
    std::error_code failure;
    if (!fs::equivalent(shard, request.out, failure)) continue;
    throw UsageError(fmt::format("--out: {} is the folder of a shard, another folder expected",
                                 request.out.string()));
  }
}

ExitStatus refuse(const std::vector<Defect>& defects) {
  for (const Defect& defect : defects) {
    printFailure({ExitStatus::badInput, defect.what});
    if (defect.command.empty()) continue;
    printError(report::withoutWorkflowCommands("  " + defect.command + "\n"));
  }
  return ExitStatus::badInput;
}

}  // namespace

ExitStatus mergeShards(const MergeRequest& request) {
  refuseShardAsOut(request);
  std::vector<Defect> defects;
  const std::vector<ShardFolder> given = readShards(request.shards, defects);
  if (given.empty()) return refuse(defects);
  const ShardManifest& common = commonManifest(given);
  const std::vector<ShardFolder> shards =
      checkedShards(given, common, request.out.string(), defects);
  // The first shard's: a run without shards has its words, the number of threads among them.
  const Arguments arguments = withOut(
      shards.empty() ? common.arguments : shards.front().manifest.arguments, request.out.string());
  RunRequest run = request.readRun(arguments);
  run.out = request.out;
  run.command = commandText(arguments);
  const std::vector<study::StudyPlan> plans = readPlans(run.studies, run.options);
  std::map<std::string, FoundCase> found = findCases(shards, common, plans, defects);
  if (!defects.empty()) return refuse(defects);
  if (!run.metricsOnly) requirePlots();
  const std::unique_ptr<cache::Cache> cache = openCache(run.noCache || request.noCache);
  KeptCases cases(std::move(found));
  return runPlans(plans, cases, run, *cache);
}

}  // namespace gnomon::cli
