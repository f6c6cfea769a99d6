#include "cli/plan_runs.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>

#include "cli/output.h"
#include "cli/study_plans.h"
#include "common/text/shell_quote.h"
#include "report/figure_files.h"
#include "report/json/ranking_json.h"
#include "report/page/ranking_html.h"
#include "report/page/terminal_report.h"
#include "report/plots/gnuplot.h"
#include "report/run_files.h"
#include "report/suite/suite_files.h"
#include "report/tables/formats/csv_format.h"
#include "report/tables/formats/markdown_format.h"
#include "report/tables/means_table.h"
#include "report/tables/ranked_table.h"
#include "study/judge/claims.h"
#include "study/judge/sweep_result.h"
#include "study/spec/mask_files.h"
#include "study/spec/resolved_study.h"
#include "study/spec/study_inputs.h"

namespace gnomon::cli {
namespace fs = std::filesystem;
namespace {

void writeCopy(const toml::table& study, report::RunFolder& folder, const std::string& name) {
  folder.write(name, study::studyCopyText(study, folder.path() / name));
}

/// The command that gives figures again, from their own folder: it does not tell where that is.
std::string figuresCommand(const study::StudyPlan& plan) {
  return fmt::format("gnomon run {} --metrics-only", shellQuoted(study::studyCopyName(plan.name)));
}

/// The command that runs a step again: its own copy, as the file's study has all values.
std::string commandOf(const study::StudyPlan& plan, const study::StudySpec& step,
                      const RunRequest& request) {
  if (request.metricsOnly) return figuresCommand(plan);
  if (!plan.sweep) return request.command;
  const fs::path copy = request.out / step.name / study::studyCopyName(step.name);
  return "gnomon run " + shellQuoted(copy.string());
}

study::CaseRecord reproductionOf(const study::StudySpec& study, const fs::path& folder) {
  return inStudy(study, [&] {
    return study::CaseRecord{study::studyCopyName(study.name), study::resolvedStudy(study, folder),
                             study::studyInputs(study, folder)};
  });
}

study::StudyRecord runOne(const study::StudyPlan& plan, const study::StudySpec& study,
                          CaseSource& cases, const RunRequest& request, report::RunFolder& folder) {
  study::CaseRecord reproduction = reproductionOf(study, folder.path());
  study::StudyRecord record = cases.measure(study, folder);
  writeCopy(reproduction.settings, folder, reproduction.file);
  record.command = commandOf(plan, study, request);
  record.reproduction = std::move(reproduction);
  return record;
}

/// The figures of a study; of one that is no step of a sweep also its copy, in its folder.
study::StudyRecord runFigures(const study::StudyPlan& plan, const study::StudySpec& study,
                              CaseSource& cases, const RunRequest& request, RunFolders& folders) {
  study::CaseRecord reproduction;
  if (!plan.sweep) {
    report::RunFolder& folder = folders.of(study.name);
    reproduction = reproductionOf(study, folder.path());
    writeCopy(reproduction.settings, folder, reproduction.file);
  }
  study::StudyRecord record = cases.measureFigures(study);
  record.command = commandOf(plan, study, request);
  record.reproduction = std::move(reproduction);
  return report::figuresAlone(std::move(record), plan.sweep.has_value());
}

void measureStep(const study::StudyPlan& plan, const study::StudySpec& step, CaseSource& cases,
                 const RunRequest& request, Records& records) {
  study::StudyRecord record =
      request.metricsOnly ? runFigures(plan, step, cases, request, records.folders)
                          : runOne(plan, step, cases, request, records.folders.of(step.name));
  records.all.push_back(std::move(record));
}

void writeReports(const study::StudyRecord& record, report::RunFolder& folder,
                  const RunRequest& request, cache::Cache& cache) {
  if (request.metricsOnly) return report::writeFigureFiles(record, folder);
  report::writeRunFiles(record, request.paper, folder, cache);
}

/// Judges a study's claims and writes its reports.
void report(const study::StudySpec& study, Records& records, std::size_t own,
            const RunRequest& request, cache::Cache& cache) {
  records.all[own].claims = study::judgeClaims(study.claims, records.all[own]);
  // The figures of a step are told by its sweep.
  const std::string& name = records.all[own].name;
  if (!records.folders.holds(name)) return;
  writeReports(records.all[own], records.folders.of(name), request, cache);
}

/// The same, the reports perhaps while the next step is measured, of a copy.
void reportBeside(const study::StudySpec& study, Records& records, std::size_t own,
                  const RunRequest& request, cache::Cache& cache, CaseSource& cases) {
  records.all[own].claims = study::judgeClaims(study.claims, records.all[own]);
  const std::string& name = records.all[own].name;
  if (!records.folders.holds(name)) return;
  cases.report([record = records.all[own], &folder = records.folders.of(name), &request, &cache] {
    writeReports(record, folder, request, cache);
  });
}

/// Waits for the reports of a plan, however it ends: they are written to its records' folders.
class ReportsOfPlan {
 public:
  explicit ReportsOfPlan(CaseSource& cases) : cases_(cases) {}
  ReportsOfPlan(const ReportsOfPlan&) = delete;
  ReportsOfPlan& operator=(const ReportsOfPlan&) = delete;
  ~ReportsOfPlan() {
    try {
      cases_.finishReports();
    } catch (...) {  // NOLINT(bugprone-empty-catch): another failure ended the plan
    }
  }
  void finish() { cases_.finishReports(); }

 private:
  CaseSource& cases_;
};

study::SweepRecord sweepOf(const PlanRecords& part, const Records& records,
                           const RunRequest& request) {
  const auto begin = records.all.begin() + static_cast<std::ptrdiff_t>(part.first);
  const auto count = static_cast<std::ptrdiff_t>(part.plan->steps.size());
  study::SweepRecord sweep =
      study::makeSweepRecord(*part.plan, std::vector<study::StudyRecord>(begin, begin + count),
                             request.metricsOnly ? figuresCommand(*part.plan) : request.command);
  sweep.hasStepReports = !request.metricsOnly;
  return sweep;
}

void writeSweep(const PlanRecords& part, Records& records, const RunRequest& request,
                cache::Cache& cache) {
  report::RunFolder& folder = records.folders.of(part.plan->name);
  const study::SweepRecord sweep = sweepOf(part, records, request);
  if (request.metricsOnly) return report::writeFigureFiles(sweep, folder);
  report::writeSweepFiles(sweep, request.paper, folder, cache);
}

/// @throws InputError naming the first mask of another program that is missing
void requireMasks(const study::StudySpec& step) {
  inStudy(step, [&] {
    for (const study::MethodSpec& method : step.methods) {
      (void)study::givenMaskFiles(step, method);
    }
  });
}

void runSteps(const PlanRecords& part, CaseSource& cases, const RunRequest& request,
              cache::Cache& cache, Records& records, const StepJudge& judgeStep) {
  const study::StudyPlan& plan = *part.plan;
  for (const study::StudySpec& step : plan.steps) requireMasks(step);
  for (const study::StudySpec& step : plan.steps) cases.prepare(step);
  report::RunFolder& folder = records.folders.of(plan.name);
  std::optional<toml::table> swept;
  if (plan.sweep) swept = study::sweepStudy(plan.steps.front(), request.options, folder.path());
  ReportsOfPlan reports(cases);
  for (const study::StudySpec& step : plan.steps) {
    measureStep(plan, step, cases, request, records);
    if (judgeStep) judgeStep(records.all.back());
    // At once, so that a later failure leaves this one's report.
    reportBeside(step, records, records.all.size() - 1, request, cache, cases);
  }
  reports.finish();
  if (swept) {
    writeCopy(*swept, folder, study::studyCopyName(plan.name));
    writeSweep(part, records, request, cache);
  }
}

}  // namespace

void runStep(const study::StudyPlan& plan, const study::StudySpec& step, CaseSource& cases,
             const RunRequest& request, cache::Cache& cache, Records& records,
             const StepJudge& judge) {
  measureStep(plan, step, cases, request, records);
  if (judge) judge(records.all.back());
  // At once, so that a later failure leaves this one's report.
  report(step, records, records.all.size() - 1, request, cache);
}

std::size_t caseCount(std::span<const study::StudyPlan> plans) {
  std::size_t count = 0;
  for (const study::StudyPlan& plan : plans) count += plan.steps.size();
  return count;
}

PlanRecords runPlan(const study::StudyPlan& plan, CaseSource& cases, const RunRequest& request,
                    cache::Cache& cache, Records& records, const StepJudge& judge) {
  const PlanRecords part{&plan, records.all.size()};
  try {
    runSteps(part, cases, request, cache, records, judge);
  } catch (...) {
    // Nothing may speak of a study of which a part is missing.
    records.all.erase(records.all.begin() + static_cast<std::ptrdiff_t>(part.first),
                      records.all.end());
    throw;
  }
  return part;
}

void reportPlan(const PlanRecords& part, const RunRequest& request, cache::Cache& cache,
                Records& records) {
  const study::StudyPlan& plan = *part.plan;
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    report(plan.steps[i], records, part.first + i, request, cache);
  }
  if (!plan.sweep) return;
  writeSweep(part, records, request, cache);
}

study::StudyMeans meansOf(const PlanRecords& part, const RunRequest& request,
                          const Records& records) {
  return part.plan->sweep ? study::studyMeans(sweepOf(part, records, request))
                          : study::studyMeans(records.all[part.first]);
}

void printPlan(const PlanRecords& part, const RunRequest& request, const Records& records) {
  const study::StudyPlan& plan = *part.plan;
  const std::string table =
      plan.sweep ? report::terminalReport(sweepOf(part, records, request), coloursWanted())
                 : report::terminalReport(records.all[part.first], coloursWanted());
  printText(table + "\n");
  const fs::path folder = request.out / plan.name;
  printLine(request.metricsOnly ? "Figures: " + (folder / "cases.csv").string()
                                : "Report: " + (folder / "report.html").string());
  printText("\n");
}

bool isRanking(std::span<const study::StudyPlan> plans) {
  return std::count_if(plans.begin(), plans.end(), isRanked) > 1;
}

bool isRanked(const study::StudyPlan& plan) {
  return plan.steps.front().ranked;
}

void reportRanking(std::span<const study::StudyMeans> studies, const RunRequest& request,
                   report::RunFolder& folder) {
  for (const study::StudyMeans& study : studies) folder.add(study.name + "/");
  folder.write("ranking.csv", report::csvTable(report::studyMeansTable(studies)));
  const report::SuiteParts parts =
      request.metricsOnly ? report::SuiteParts::figures : report::SuiteParts::all;
  if (report::writeSuiteOf(studies, request.command, parts, request.paper, folder)) {
    const char* name = request.metricsOnly ? "suite.json" : "suite.html";
    printLine("Over the scenes: " + (request.out / name).string());
  }
  if (request.metricsOnly) return folder.finish(report::rankingJson(studies, request.command));
  folder.write("ranking.md", report::markdownTable(report::rankedOverStudiesTable(
                                 studies, study::rankOverStudies(studies))));
  folder.write("ranking.html", report::rankingHtml(studies, request.command).text());
  folder.finish(report::rankingJson(studies, request.command));
}

void requirePlots() {
  (void)report::gnuplotVersion();
}

}  // namespace gnomon::cli
