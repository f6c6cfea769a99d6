#include "cli/commands/run_command.h"

#include <fmt/core.h>

#include <memory>

#include "cli/commands/cache_command.h"
#include "cli/failure.h"
#include "cli/output.h"
#include "cli/paper_request.h"
#include "cli/run_plans.h"
#include "cli/shards/shard_run.h"
#include "cli/study_plans.h"
#include "cli/terminal_progress.h"
#include "common/files/part_file.h"
#include "common/system/memory.h"
#include "horizon/table_file.h"
#include "study/run/truth_study.h"

namespace gnomon::cli {
namespace fs = std::filesystem;
namespace {

void bakeTables(const study::StudySpec& study, const fs::path& out, cache::Cache& cache) {
  TerminalProgress progress(study.name);
  const horizon::StoredHorizons stored =
      study::bakeStudyTables(study, cache, [&](double share) { progress.update("bake", share); });
  const fs::path path = out / study.name / "tables.exr";
  removeLeftovers(path.parent_path());
  horizon::writeHorizons(path, stored);
  printLine(fmt::format("{}: {} × {} texels, {} azimuths, {} in {} bits", path.string(),
                        stored.width, stored.height, stored.layers,
                        formatBytes(static_cast<double>(stored.byteCount())),
                        static_cast<int>(study.bake.bits)));
}

}  // namespace

ExitStatus runStudies(const RunRequest& request) {
  if (request.shard) return runShard(request);
  const std::vector<study::StudyPlan> plans = readPlans(request.studies, request.options);
  requirePaperMethods(request.paper, plans);
  Failures failures;
  return measurePlans(plans, request, failures);
}

ExitStatus bakeStudies(const RunRequest& request) {
  const std::vector<study::StudyPlan> plans = readPlans(request.studies, request.options);
  const std::unique_ptr<cache::Cache> cache = openCache(request.noCache);
  Failures failures;
  for (const study::StudyPlan& plan : plans) {
    for (const study::StudySpec& step : plan.steps) {
      failures.attempt([&] { bakeTables(step, request.out, *cache); });
    }
  }
  failures.print();
  return failures.status();
}

}  // namespace gnomon::cli
