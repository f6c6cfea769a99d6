#include "gnomon/study.h"

#include <memory>

#include "api/inner/conversions.h"
#include "cli/commands/cache_command.h"
#include "cli/commands/run_command.h"
#include "cli/plan_runs.h"
#include "cli/study_plans.h"
#include "common/text.h"
#include "render/gl_context.h"
#include "report/text/verdict_text.h"
#include "study/record/gate.h"

namespace gnomon {
inline namespace api {
namespace {

/// The command line that does the same, for the report.
std::string commandOf(const std::filesystem::path& study, const RunOptions& options) {
  std::string text = "gnomon run " + shellQuoted(study.string());
  text += " --out " + shellQuoted(options.out.string());
  for (const std::string& method : options.methods) text += " --method " + shellQuoted(method);
  for (const std::string& setting : options.settings) text += " --set " + shellQuoted(setting);
  if (options.quick) text += " --quick";
  if (!options.cache) text += " --no-cache";
  return text;
}

cli::RunRequest requestOf(const std::filesystem::path& study, const RunOptions& options) {
  cli::RunRequest request;
  request.studies = {study};
  request.out = options.out;
  request.options.methods = options.methods;
  request.options.overrides = options.settings;
  request.options.quick = options.quick;
  request.noCache = !options.cache;
  request.command = commandOf(study, options);
  return request;
}

/// Gates that do not hold, and what was not measured.
std::vector<std::string> failuresOf(const std::vector<study::StudyRecord>& records) {
  std::vector<std::string> lines;
  for (const study::StudyRecord& record : records) {
    for (const study::Judgement& judgement : record.judgements) {
      if (judgement.isFault()) lines.push_back(report::gateFaultText(judgement));
    }
    for (const study::ProblemRecord& problem : record.problems) lines.push_back(problem.message);
  }
  return lines;
}

RunResult run(const cli::RunRequest& request) {
  const std::vector<study::StudyPlan> plans = cli::readPlans(request.studies, request.options);
  const render::GlContext gl;
  cli::requirePlots();
  const std::unique_ptr<cache::Cache> cache = cli::openCache(request.noCache);
  cli::Records records;
  records.folders.claim(plans.front(), request.out);
  records.folders.clear(request.out);
  cli::MeasuredCases cases(gl, request, *cache, cli::caseCount(plans));
  (void)cli::runPlan(plans.front(), cases, request, *cache, records);
  std::vector<std::string> failures = failuresOf(records.all);
  return {request.out / plans.front().name / "summary.json", failures.empty(), std::move(failures)};
}

}  // namespace

RunResult runStudy(const std::filesystem::path& study, const RunOptions& options) {
  cli::RunRequest request = requestOf(study, options);
  return watched(options.progress, [&](const auto& tell) {
    request.progress = tell;
    return onOwnThread([&] { return run(request); });
  });
}

}  // namespace api
}  // namespace gnomon
