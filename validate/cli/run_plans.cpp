#include "cli/run_plans.h"

#include <algorithm>
#include <memory>

#include "cli/case_source.h"
#include "cli/commands/cache_command.h"
#include "cli/output.h"
#include "report/page/terminal_report.h"
#include "report/plots/gnuplot.h"

namespace gnomon::cli {

void claimFolders(const std::vector<study::StudyPlan>& plans, const RunRequest& request,
                  RunFolders& folders) {
  for (const study::StudyPlan& plan : plans) {
    folders.claim(plan, request.out, !request.metricsOnly);
  }
  if (!request.shard && isRanking(plans)) folders.claimRanking(request.out);
  folders.clear(request.out);
}

ExitStatus measurePlans(const std::vector<study::StudyPlan>& plans, const RunRequest& request,
                        Failures& failures) {
  if (!request.metricsOnly) report::askGnuplotVersion();  // which it tells while OpenGL starts
  const render::GlContext gl;
  if (!request.metricsOnly) requirePlots();
  const std::unique_ptr<cache::Cache> cache = openCache(request.noCache);
  MeasuredCases cases(gl, request, *cache, caseCount(plans));
  Records records;
  claimFolders(plans, request, records.folders);
  std::vector<PlanRecords> whole;
  for (const study::StudyPlan& plan : plans) {
    failures.attempt([&] { whole.push_back(runPlan(plan, cases, request, *cache, records)); });
  }
  return finishPlans(whole, request, records, failures);
}

ExitStatus finishPlans(std::span<const PlanRecords> plans, const RunRequest& request,
                       Records& records, Failures& failures) {
  std::vector<study::StudyMeans> ranked;
  for (const PlanRecords& part : plans) {
    failures.attempt([&] {
      study::StudyMeans means = meansOf(part, request, records);
      printPlan(part, request, records);
      if (isRanked(*part.plan)) ranked.push_back(std::move(means));
    });
  }
  if (ranked.size() > 1 && !request.shard) {
    failures.attempt([&] {
      reportRanking(ranked, request, records.folders.ranking());
      printText(report::terminalReport(ranked, coloursWanted()) + "\n");
      printLine("Report: " +
                (request.out / (request.metricsOnly ? "ranking.csv" : "ranking.html")).string());
    });
  }
  failures.print();
  // A run judges no gate; a method that the driver did not let it measure is a problem.
  ExitStatus worst = failures.status();
  for (const study::StudyRecord& record : records.all) {
    worst = std::max(worst, study::worstOf(record.problems));
  }
  return worst;
}

}  // namespace gnomon::cli
