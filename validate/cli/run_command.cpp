#include "cli/run_command.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <span>

#include "cli/study_plans.h"
#include "cli/terminal_progress.h"
#include "common/atomic_file.h"
#include "common/memory.h"
#include "relief/table_file.h"
#include "render/gl_context.h"
#include "report/folder_writer.h"
#include "report/gnuplot.h"
#include "report/ranking_html.h"
#include "report/ranking_json.h"
#include "report/run_files.h"
#include "report/terminal_ranking.h"
#include "report/terminal_sweep.h"
#include "report/terminal_table.h"
#include "study/claims.h"
#include "study/run_study.h"
#include "study/sweep.h"
#include "study/truth_study.h"

namespace gnomon {
namespace fs = std::filesystem;
namespace {

/// @throws InputError where a check would have nothing to check
void requireThresholds(const std::vector<StudyPlan>& plans) {
  for (const StudyPlan& plan : plans) {
    const StudySpec& study = plan.steps.front();
    if (!study.thresholds.empty()) continue;
    throw InputError(
        fmt::format("{}: no [[threshold]], so there is nothing to check", study.file.string()));
  }
}

constexpr std::array rankingFiles = {"ranking.json", "ranking.csv", "ranking.html"};

void removeFiles(const fs::path& folder, std::span<const char* const> names) {
  for (const char* name : names) {
    std::error_code ignored;
    fs::remove(folder / name, ignored);
  }
}

StudyRecord runOne(const StudySpec& study, const GlContext& gl, const RunRequest& request) {
  const fs::path folder = request.out / study.name;
  // Older figures must not stand beside newer pictures.
  removeRunFiles(folder);
  FolderWriter writer(folder);
  TerminalProgress progress(study.name);
  StudyRecord record = inStudy(study, [&] {
    return runStudy(study, gl, writer,
                    [&](std::string_view stage, double share) { progress.update(stage, share); });
  });
  record.command = request.command;
  return record;
}

/// Judges a study's claims by what the run holds so far, and writes its reports.
void report(const StudySpec& study, std::vector<StudyRecord>& records, std::size_t own,
            const fs::path& out) {
  StudyRecord& record = records[own];
  record.claims = judgeClaims(study.claims, records, own);
  writeRunFiles(record, out / record.name);
}

/// Whether a claim of the study needs the record of another one, which may be run later.
bool speaksOfOthers(const StudySpec& study) {
  return std::any_of(study.claims.begin(), study.claims.end(),
                     [](const ClaimSpec& claim) { return !claim.gainExceeds.empty(); });
}

/// The records of all steps of all plans, one after the other.
using Records = std::vector<StudyRecord>;

/// The part of the records that belongs to a plan.
struct PlanRecords {
  const StudyPlan* plan;
  std::size_t first;
};

SweepRecord sweepOf(const PlanRecords& part, const Records& records, const RunRequest& request) {
  const auto begin = records.begin() + static_cast<std::ptrdiff_t>(part.first);
  const auto count = static_cast<std::ptrdiff_t>(part.plan->steps.size());
  return makeSweepRecord(*part.plan, Records(begin, begin + count), request.command);
}

/// Runs all steps of a plan and adds their records.
PlanRecords runPlan(const StudyPlan& plan, const GlContext& gl, const RunRequest& request,
                    Records& records) {
  const PlanRecords part{&plan, records.size()};
  if (plan.sweep) removeRunFiles(request.out / plan.name);
  for (const StudySpec& step : plan.steps) {
    records.push_back(runOne(step, gl, request));
    // At once, so that a later failure leaves this one's report.
    report(step, records, records.size() - 1, request.out);
  }
  if (plan.sweep) writeSweepFiles(sweepOf(part, records, request), request.out / plan.name);
  return part;
}

/// Judges again what speaks of other studies, now that all have run; prints the plan's table.
/// @return what it gives to the ranking
StudyMeans finishPlan(const PlanRecords& part, const RunRequest& request, Records& records) {
  const StudyPlan& plan = *part.plan;
  const bool again = speaksOfOthers(plan.steps.front());
  for (std::size_t i = 0; again && i < plan.steps.size(); ++i) {
    report(plan.steps[i], records, part.first + i, request.out);
  }
  const auto print = [&](const std::string& table) {
    fmt::print("{}\nReport: {}\n\n", table, (request.out / plan.name / "report.html").string());
  };
  if (!plan.sweep) {
    print(resultTable(records[part.first], coloursWanted()));
    return studyMeans(records[part.first]);
  }
  const SweepRecord sweep = sweepOf(part, records, request);
  if (again) writeSweepFiles(sweep, request.out / plan.name);
  print(sweepTable(sweep, coloursWanted()));
  return studyMeans(sweep);
}

/// Ranks the methods over all studies, and prints and writes that.
void reportRanking(std::span<const StudyMeans> studies, const RunRequest& request) {
  writeTextAtomically(request.out / "ranking.csv", rankingCsv(studies));
  writeTextAtomically(request.out / "ranking.html", rankingHtml(studies, request.command));
  writeTextAtomically(request.out / "ranking.json", rankingJson(studies, request.command));
  fmt::print("{}\nReport: {}\n", rankingOverStudies(studies, coloursWanted()),
             (request.out / "ranking.html").string());
}

/// That plots can be drawn shows before anything is run.
void requirePlots() {
  (void)runGnuplot("");
}

}  // namespace

ExitStatus runStudies(const RunRequest& request) {
  const std::vector<StudyPlan> plans = readPlans(request.studies, request.options);
  if (request.check) requireThresholds(plans);
  requirePlots();
  const GlContext gl;
  const auto isRanked = [](const StudyPlan& plan) { return plan.steps.front().ranked; };
  const bool ranked = std::count_if(plans.begin(), plans.end(), isRanked) > 1;
  if (ranked) removeFiles(request.out, rankingFiles);
  Records records;
  std::vector<PlanRecords> parts;
  for (const StudyPlan& plan : plans) parts.push_back(runPlan(plan, gl, request, records));
  std::vector<StudyMeans> studies;
  bool passed = true;
  for (const PlanRecords& part : parts) {
    StudyMeans means = finishPlan(part, request, records);
    passed = passed && means.passed;
    if (isRanked(*part.plan)) studies.push_back(std::move(means));
  }
  if (ranked) reportRanking(studies, request);
  return request.check && !passed ? ExitStatus::thresholdFailed : ExitStatus::pass;
}

namespace {

void bakeTables(const StudySpec& study, const fs::path& out) {
  TerminalProgress progress(study.name);
  const StoredHorizons stored =
      bakeStudyTables(study, [&](double share) { progress.update("bake", share); });
  const fs::path path = out / study.name / "tables.exr";
  writeHorizons(path, stored);
  fmt::print("{}: {} × {} texels, {} azimuths, {} in {} bits\n", path.string(), stored.width,
             stored.height, stored.azimuths, formatBytes(static_cast<double>(stored.byteCount())),
             static_cast<int>(study.bake.bits));
}

}  // namespace

ExitStatus bakeStudies(const RunRequest& request) {
  for (const StudyPlan& plan : readPlans(request.studies, request.options)) {
    for (const StudySpec& step : plan.steps) bakeTables(step, request.out);
  }
  return ExitStatus::pass;
}

}  // namespace gnomon
