#include "cli/run_command.h"

#include <fmt/core.h>

#include <memory>

#include "cli/cache_command.h"
#include "cli/plan_runs.h"
#include "cli/study_plans.h"
#include "cli/terminal_progress.h"
#include "common/memory.h"
#include "common/part_file.h"
#include "relief/table_file.h"
#include "report/gnuplot.h"
#include "report/terminal_ranking.h"
#include "study/truth_study.h"

namespace gnomon {
namespace fs = std::filesystem;
namespace {

void bakeTables(const StudySpec& study, const fs::path& out, Cache& cache) {
  TerminalProgress progress(study.name);
  const StoredHorizons stored =
      bakeStudyTables(study, cache, [&](double share) { progress.update("bake", share); });
  const fs::path path = out / study.name / "tables.exr";
  removeLeftovers(path.parent_path());
  writeHorizons(path, stored);
  fmt::print("{}: {} × {} texels, {} azimuths, {} in {} bits\n", path.string(), stored.width,
             stored.height, stored.azimuths, formatBytes(static_cast<double>(stored.byteCount())),
             static_cast<int>(study.bake.bits));
}

}  // namespace

ExitStatus runStudies(const RunRequest& request) {
  const std::vector<StudyPlan> plans = readPlans(request.studies, request.options);
  askGnuplotVersion();  // which it tells while OpenGL starts
  const GlContext gl;
  requirePlots();
  const std::unique_ptr<Cache> cache = openCache(request.noCache);
  Records records;
  for (const StudyPlan& plan : plans) records.folders.claim(plan, request.out);
  if (isRanking(plans)) records.folders.claimRanking(request.out);
  records.folders.clear(request.out);
  std::vector<PlanRecords> parts;
  parts.reserve(plans.size());
  for (const StudyPlan& plan : plans) parts.push_back(runPlan(plan, gl, request, *cache, records));
  std::vector<StudyMeans> studies;
  for (const PlanRecords& part : parts) {
    StudyMeans means = finishPlan(part, request, *cache, records);
    printPlan(part, request, records);
    if (isRanked(*part.plan)) studies.push_back(std::move(means));
  }
  if (isRanking(plans)) {
    reportRanking(studies, request, records.folders.ranking());
    fmt::print("{}\nReport: {}\n", rankingOverStudies(studies, coloursWanted()),
               (request.out / "ranking.html").string());
  }
  return ExitStatus::pass;
}

ExitStatus bakeStudies(const RunRequest& request) {
  const std::vector<StudyPlan> plans = readPlans(request.studies, request.options);
  const std::unique_ptr<Cache> cache = openCache(request.noCache);
  for (const StudyPlan& plan : plans) {
    for (const StudySpec& step : plan.steps) bakeTables(step, request.out, *cache);
  }
  return ExitStatus::pass;
}

}  // namespace gnomon
