#include "cli/run_command.h"

#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "cli/cache_command.h"
#include "cli/failure.h"
#include "cli/output.h"
#include "cli/plan_runs.h"
#include "cli/study_plans.h"
#include "cli/terminal_progress.h"
#include "common/files/part_file.h"
#include "common/system/memory.h"
#include "horizon/table_file.h"
#include "report/page/terminal_report.h"
#include "report/plots/gnuplot.h"
#include "study/run/truth_study.h"

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
  printLine(fmt::format("{}: {} × {} texels, {} azimuths, {} in {} bits", path.string(),
                        stored.width, stored.height, stored.layers,
                        formatBytes(static_cast<double>(stored.byteCount())),
                        static_cast<int>(study.bake.bits)));
}

/// A run judges no gate; a method that the driver did not let it measure is a problem.
ExitStatus worstProblem(const std::vector<StudyRecord>& records) {
  ExitStatus worst = ExitStatus::pass;
  for (const StudyRecord& record : records) worst = std::max(worst, worstOf(record.problems));
  return worst;
}

}  // namespace

ExitStatus runStudies(const RunRequest& request) {
  const std::vector<StudyPlan> plans = readPlans(request.studies, request.options);
  if (!request.metricsOnly) askGnuplotVersion();  // which it tells while OpenGL starts
  const GlContext gl;
  if (!request.metricsOnly) requirePlots();
  const std::unique_ptr<Cache> cache = openCache(request.noCache);
  Records records;
  records.line = std::make_shared<TerminalProgress>("", caseCount(plans));
  for (const StudyPlan& plan : plans) {
    records.folders.claim(plan, request.out, !request.metricsOnly);
  }
  if (isRanking(plans)) records.folders.claimRanking(request.out);
  records.folders.clear(request.out);
  Failures failures;
  std::vector<PlanRecords> whole;
  for (const StudyPlan& plan : plans) {
    failures.attempt([&] { whole.push_back(runPlan(plan, gl, request, *cache, records)); });
  }
  std::vector<StudyMeans> ranked;
  for (const PlanRecords& part : whole) {
    failures.attempt([&] {
      StudyMeans means = finishPlan(part, request, *cache, records);
      printPlan(part, request, records);
      if (isRanked(*part.plan)) ranked.push_back(std::move(means));
    });
  }
  if (ranked.size() > 1) {
    failures.attempt([&] {
      reportRanking(ranked, request, records.folders.ranking());
      printText(terminalReport(ranked, coloursWanted()) + "\n");
      printLine("Report: " +
                (request.out / (request.metricsOnly ? "ranking.csv" : "ranking.html")).string());
    });
  }
  failures.print();
  return std::max(failures.status(), worstProblem(records.all));
}

ExitStatus bakeStudies(const RunRequest& request) {
  const std::vector<StudyPlan> plans = readPlans(request.studies, request.options);
  const std::unique_ptr<Cache> cache = openCache(request.noCache);
  Failures failures;
  for (const StudyPlan& plan : plans) {
    for (const StudySpec& step : plan.steps) {
      failures.attempt([&] { bakeTables(step, request.out, *cache); });
    }
  }
  failures.print();
  return failures.status();
}

}  // namespace gnomon
