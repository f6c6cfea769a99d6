#include "cli/study_plans.h"

#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "cli/commands/cache_command.h"
#include "report/page/terminal_report.h"
#include "report/plots/gnuplot.h"

namespace gnomon::cli {

std::vector<study::StudyPlan> readPlans(const std::vector<std::filesystem::path>& studies,
                                        const study::StudyOptions& options) {
  std::vector<study::StudyPlan> plans;
  std::set<std::string> names;
  for (const std::filesystem::path& file : studies) {
    plans.push_back(study::readStudyPlan(file, options));
    requireNewName(names, file, plans.back().name);
  }
  return plans;
}

std::vector<study::StudyPlan> readOutlines(const std::vector<std::filesystem::path>& studies,
                                           study::StudyOptions options) {
  options.isOutline = true;
  return readPlans(studies, options);
}

void requireNewName(std::set<std::string>& names, const std::filesystem::path& file,
                    const std::string& name) {
  if (names.insert(name).second) return;
  throw InputError(fmt::format("{}: study.name: \"{}\" is the name of another study of this run",
                               file.string(), name));
}

bool isStep(const study::StudySpec& study) {
  return study.name.find('/') != std::string::npos;
}

std::string placeOf(const study::StudySpec& study) {
  return isStep(study) ? fmt::format("{}: {}", study.file.string(), study.name)
                       : study.file.string();
}

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
