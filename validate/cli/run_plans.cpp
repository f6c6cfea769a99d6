#include "cli/run_plans.h"

#include <algorithm>

#include "cli/failure.h"
#include "cli/output.h"
#include "cli/plan_runs.h"
#include "report/page/terminal_report.h"

namespace gnomon::cli {

ExitStatus worstProblem(const std::vector<study::StudyRecord>& records) {
  ExitStatus worst = ExitStatus::pass;
  for (const study::StudyRecord& record : records)
    worst = std::max(worst, study::worstOf(record.problems));
  return worst;
}

ExitStatus runPlans(const std::vector<study::StudyPlan>& plans, CaseSource& cases,
                    const RunRequest& request, cache::Cache& cache) {
  Records records;
  for (const study::StudyPlan& plan : plans) {
    records.folders.claim(plan, request.out, !request.metricsOnly);
  }
  if (isRanking(plans)) records.folders.claimRanking(request.out);
  records.folders.clear(request.out);
  Failures failures;
  std::vector<PlanRecords> whole;
  for (const study::StudyPlan& plan : plans) {
    failures.attempt([&] { whole.push_back(runPlan(plan, cases, request, cache, records)); });
  }
  std::vector<study::StudyMeans> ranked;
  for (const PlanRecords& part : whole) {
    failures.attempt([&] {
      study::StudyMeans means = meansOf(part, request, records);
      printPlan(part, request, records);
      if (isRanked(*part.plan)) ranked.push_back(std::move(means));
    });
  }
  if (ranked.size() > 1) {
    failures.attempt([&] {
      reportRanking(ranked, request, records.folders.ranking());
      printText(report::terminalReport(ranked, coloursWanted()) + "\n");
      printLine("Report: " +
                (request.out / (request.metricsOnly ? "ranking.csv" : "ranking.html")).string());
    });
  }
  failures.print();
  return std::max(failures.status(), worstProblem(records.all));
}

}  // namespace gnomon::cli
