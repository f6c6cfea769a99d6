#include "cli/plan_runs.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "cli/study_plans.h"
#include "common/parallel.h"
#include "common/text.h"
#include "report/json/results_json.h"
#include "report/page/overview_html.h"
#include "report/plots/gnuplot.h"
#include "report/suite/suite_files.h"
#include "report/tables/ranked_table.h"
#include "report/tables/table.h"
#include "report/terminal_report.h"
#include "study/judge/claims.h"
#include "study/run/method_trial.h"
#include "study/run/run_study.h"
#include "study/spec/resolved_study.h"
#include "study/spec/sections/method_section.h"

namespace gnomon::cli {
namespace fs = std::filesystem;
namespace {

const report::FolderKind rankingKind{
    "ranking.json", {"ranking.csv", "ranking.md", "ranking.html"}, "ranking.txt", true};

}  // namespace

const report::FolderKind studyFolderKind{"summary.json", {"report.html"}};

std::vector<fs::path> inputsBeside(const study::StudyPlan& plan) {
  std::vector<fs::path> inputs = study::inputFiles(plan.steps.front());
  std::erase(inputs, plan.steps.front().file);
  return inputs;
}

void RunFolders::claim(const study::StudyPlan& plan, const fs::path& out, bool withSteps) {
  const std::vector<fs::path> inputs = inputsBeside(plan);
  const auto checked = [&](const std::string& name) {
    study::requireCopyOrNothing(out / name / study::studyCopyName(name));
    report::RunFolder folder(out / name, studyFolderKind);
    folder.requireNone(inputs);
    return folder;
  };
  report::RunFolder folder = checked(plan.name);
  std::vector<std::string> steps;
  for (const study::StudySpec& step : plan.steps) {
    if (step.name == plan.name || !withSteps) continue;
    (void)checked(step.name);
    steps.push_back(step.name);
  }
  folders_.emplace(plan.name, std::move(folder));
  steps_.emplace(plan.name, std::move(steps));
}

void RunFolders::claimRanking(const fs::path& out) {
  ranking_.emplace(out, rankingKind);
}

void RunFolders::clear(const fs::path& out) {
  report::RunFolder old(out, rankingKind);
  const bool tellsOfOurs = std::any_of(folders_.begin(), folders_.end(), [&](const auto& folder) {
    return old.names(folder.first + "/");
  });
  if (ranking_) {
    ranking_->clear();
  } else if (tellsOfOurs) {
    old.clear();
  }
  for (const auto& [study, steps] : steps_) {
    report::RunFolder& folder = folders_.at(study);
    folder.clear();
    for (const std::string& step : steps) {
      folders_.emplace(step, report::RunFolder(folder, step.substr(study.size() + 1)));
    }
  }
}

/// Does work that takes a StageProgress: that of the request, or a line on the terminal.
template <typename Work>
study::StudyRecord MeasuredCases::shown(const study::StudySpec& study, const Work& work) {
  study::StageProgress progress = request_.progress;
  if (!progress) {
    progress = [this](std::string_view stage, double share) { line_.update(stage, share); };
  }
  cache_.expectCases(isStep(study));
  study::StudyRecord record = inStudy(study, [&] { return work(progress); });
  line_.clear();
  return record;
}

void MeasuredCases::prepare(const study::StudySpec& study) {
  inStudy(study, [&] { study::tryMethods(study, gl_, cache_); });
}

study::StudyRecord MeasuredCases::measure(const study::StudySpec& study,
                                          report::RunFolder& folder) {
  line_.beginCase(study.name);
  report::FolderWriter writer(folder, [this] { reports_.wait(); });
  return shown(study, [&](const study::StageProgress& progress) {
    return study::runStudy(study, gl_, writer, cache_, progress);
  });
}

study::StudyRecord MeasuredCases::measureFigures(const study::StudySpec& study) {
  line_.beginCase(study.name);
  return shown(study, [&](const study::StageProgress& progress) {
    return study::runStudyFigures(study, gl_, cache_, progress);
  });
}

void MeasuredCases::report(const std::function<void()>& write) {
  if (threadCount() > 1) return reports_.start(write);
  write();
}

namespace {

void writeCopy(const toml::table& study, report::RunFolder& folder, const std::string& name) {
  folder.write(name, study::studyCopyText(study, folder.place() / name));
}

/// The command that gives figures again, from their own folder: it does not tell where that is.
std::string figuresCommand(const study::StudyPlan& plan) {
  return fmt::format("gnomon run {} --metrics-only", shellQuoted(study::studyCopyName(plan.name)));
}

/// The command that runs a step again: its own copy, as the file's study has all values.
std::string commandOf(const study::StudyPlan& plan, const study::StudySpec& step,
                      const RunRequest& request) {
  if (request.metricsOnly) return figuresCommand(plan);
  if (!isStep(step)) return request.command;
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
                          MeasuredCases& cases, const RunRequest& request,
                          report::RunFolder& folder) {
  study::CaseRecord reproduction = reproductionOf(study, folder.place());
  study::StudyRecord record = cases.measure(study, folder);
  writeCopy(reproduction.settings, folder, reproduction.file);
  record.command = commandOf(plan, study, request);
  record.reproduction = std::move(reproduction);
  return record;
}

/// The figures of a study; of one that is no step of a sweep also its copy, in its folder.
study::StudyRecord runFigures(const study::StudyPlan& plan, const study::StudySpec& study,
                              MeasuredCases& cases, const RunRequest& request,
                              RunFolders& folders) {
  study::CaseRecord reproduction;
  if (!plan.sweep) {
    report::RunFolder& folder = folders.of(study.name);
    reproduction = reproductionOf(study, folder.place());
    writeCopy(reproduction.settings, folder, reproduction.file);
  }
  study::StudyRecord record = cases.measureFigures(study);
  record.command = commandOf(plan, study, request);
  record.reproduction = std::move(reproduction);
  return report::figuresAlone(std::move(record), isStep(study));
}

void measureStep(const study::StudyPlan& plan, const study::StudySpec& step, MeasuredCases& cases,
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
void reportInBackground(const study::StudySpec& study, Records& records, std::size_t own,
                        const RunRequest& request, cache::Cache& cache, MeasuredCases& cases) {
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
  explicit ReportsOfPlan(MeasuredCases& cases) : cases_(cases) {}
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
  MeasuredCases& cases_;
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

/// @throws InputError naming the first mask of another program that is missing
void requireMasks(const study::StudySpec& step) {
  inStudy(step, [&] {
    for (const study::MethodSpec& method : step.methods) {
      (void)study::givenMaskFiles(step, method);
    }
  });
}

void runSteps(const PlanRecords& part, MeasuredCases& cases, const RunRequest& request,
              cache::Cache& cache, Records& records, const StepJudge& judgeStep) {
  const study::StudyPlan& plan = *part.plan;
  for (const study::StudySpec& step : plan.steps) requireMasks(step);
  for (const study::StudySpec& step : plan.steps) cases.prepare(step);
  ReportsOfPlan reports(cases);
  for (const study::StudySpec& step : plan.steps) {
    measureStep(plan, step, cases, request, records);
    if (judgeStep) judgeStep(records.all.back());
    // At once, so that a later failure leaves this one's report.
    reportInBackground(step, records, records.all.size() - 1, request, cache, cases);
  }
  reports.finish();
  if (plan.sweep) writeSweep(part, request, cache, records);
}

}  // namespace

std::size_t caseCount(std::span<const study::StudyPlan> plans) {
  std::size_t count = 0;
  for (const study::StudyPlan& plan : plans) count += plan.steps.size();
  return count;
}

PlanRecords runPlan(const study::StudyPlan& plan, MeasuredCases& cases, const RunRequest& request,
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
  if (plan.sweep) writeSweep(part, request, cache, records);
}

void writeSweep(const PlanRecords& part, const RunRequest& request, cache::Cache& cache,
                Records& records) {
  const study::StudyPlan& plan = *part.plan;
  report::RunFolder& folder = records.folders.of(plan.name);
  writeCopy(study::sweepStudy(plan.steps.front(), request.options, folder.place()), folder,
            study::studyCopyName(plan.name));
  const study::SweepRecord sweep = sweepOf(part, records, request);
  if (request.metricsOnly) return report::writeFigureFiles(sweep, folder);
  report::writeSweepFiles(sweep, request.paper, folder, cache);
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
