#include "cli/shards/shard_run.h"

#include <fmt/core.h>

#include <system_error>
#include <utility>

#include "cli/failure.h"
#include "cli/paper_request.h"
#include "cli/run_plans.h"
#include "cli/shards/shard_file.h"
#include "cli/study_plans.h"
#include "common/files/atomic_file.h"
#include "common/files/input_file.h"

namespace gnomon::cli {
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
