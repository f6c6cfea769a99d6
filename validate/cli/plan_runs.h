#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cache/cache.h"
#include "cli/commands/run_command.h"
#include "cli/output.h"
#include "common/parallel.h"
#include "render/gl_context.h"
#include "report/run_folder.h"
#include "study/judge/ranking.h"
#include "study/record/record.h"
#include "study/spec/study_file.h"
#include "study/spec/sweep/sweep.h"

namespace gnomon::cli {

/// The folder of a study, a sweep or a step of one.
extern const report::FolderKind studyFolderKind;

/// Every file that a study's runs read, without the study's own.
/// @throws InputError as inputFiles
std::vector<std::filesystem::path> inputsBeside(const study::StudyPlan& plan);

/// The folders of results that a command writes: `out/NAME` of each study and, in it, `NAME/VALUE`
/// of a sweep's values. First all are claimed, then all are cleared, before the first study is run:
/// a run that is killed leaves no summary of an earlier one that it did not reach.
class RunFolders {
 public:
  /// Changes nothing.
  /// @throws InputError where a file of somebody else's stands in the place of a summary or of the
  ///   study's copy, or the study reads what an earlier run left there
  /// @param withSteps  whether a sweep's steps have folders
  void claim(const study::StudyPlan& plan, const std::filesystem::path& out, bool withSteps = true);
  /// Likewise the ranking's files in `out`.
  void claimRanking(const std::filesystem::path& out);

  /// Begins the claimed folders, and removes in `out` a ranking that tells of them.
  void clear(const std::filesystem::path& out);

  /// Whether a study's or a step's folder has been claimed.
  [[nodiscard]] bool holds(const std::string& name) const { return folders_.contains(name); }
  [[nodiscard]] report::RunFolder& of(const std::string& name) { return folders_.at(name); }
  /// Once it is claimed.
  [[nodiscard]] report::RunFolder& ranking() { return ranking_.value(); }

 private:
  std::map<std::string, report::RunFolder> folders_;       ///< by study; when cleared by step too
  std::map<std::string, std::vector<std::string>> steps_;  ///< of each sweep: its steps' names
  std::optional<report::RunFolder> ranking_;
};

/// Measures the cases of a run, a case being a study or a step of a sweep, and tells how far it is
/// on the terminal, or whom the request names.
class MeasuredCases {
 public:
  /// All outlive the source.
  /// @param count  of the cases that will be measured
  MeasuredCases(const render::GlContext& gl, const RunRequest& request, cache::Cache& cache,
                std::size_t count)
      : gl_(gl), request_(request), cache_(cache), line_("", count) {}
  MeasuredCases(const MeasuredCases&) = delete;
  MeasuredCases& operator=(const MeasuredCases&) = delete;
  /// What the cases shared has objects of the context, which may go before the cache.
  ~MeasuredCases() { cache_.dropShared(); }

  /// Called for all cases of a plan before the first of them is measured.
  void prepare(const study::StudySpec& study);
  /// What was found, no claim judged yet; its pictures are written to the folder.
  study::StudyRecord measure(const study::StudySpec& study, report::RunFolder& folder);
  /// The figures alone, without pictures and frame times.
  study::StudyRecord measureFigures(const study::StudySpec& study);
  /// Writes a case's report: perhaps while the next case is measured.
  /// @param write  what it refers to stays until the reports are finished
  void report(const std::function<void()>& write);
  /// Waits for the reports.
  /// @throws what the last of them threw; what an earlier one threw leaves `report`
  void finishReports() { reports_.finish(); }

 private:
  template <typename Work>
  study::StudyRecord shown(const study::StudySpec& study, const Work& work);

  const render::GlContext& gl_;
  const RunRequest& request_;
  cache::Cache& cache_;
  TerminalProgress line_;
  BackgroundWork reports_;
};

/// The records of all steps of all plans of a command, one after the other, and the folders that
/// they are written to.
struct Records {
  std::vector<study::StudyRecord> all;
  RunFolders folders;
};

/// The cases of all plans together.
std::size_t caseCount(std::span<const study::StudyPlan> plans);

/// The part of the records that belongs to a plan.
struct PlanRecords {
  const study::StudyPlan* plan;
  std::size_t first;
};

/// That plots can be drawn, before anything is run.
/// @throws as runGnuplot
void requirePlots();

/// Judges the record of a step before anything is written of it.
using StepJudge = std::function<void(study::StudyRecord&)>;

/// Runs all steps of a plan, adds their records and writes its folder with its reports, and the
/// study itself, so that it can be run again from there. Where it fails, no record of the plan
/// stays.
/// @param cache    what earlier runs left, and what this one leaves
/// @param records  its folders have been claimed and cleared
PlanRecords runPlan(const study::StudyPlan& plan, MeasuredCases& cases, const RunRequest& request,
                    cache::Cache& cache, Records& records, const StepJudge& judge = {});

/// Writes a plan's reports anew.
void reportPlan(const PlanRecords& part, const RunRequest& request, cache::Cache& cache,
                Records& records);

/// Writes a sweep's own files, from the records of all its steps.
void writeSweep(const PlanRecords& part, const RunRequest& request, cache::Cache& cache,
                Records& records);

/// What the plan gives to the ranking.
study::StudyMeans meansOf(const PlanRecords& part, const RunRequest& request,
                          const Records& records);

/// Prints a plan's table and where its report is.
void printPlan(const PlanRecords& part, const RunRequest& request, const Records& records);

/// Whether a plan counts in a ranking, and whether there is one: with two such plans or more.
bool isRanked(const study::StudyPlan& plan);
bool isRanking(std::span<const study::StudyPlan> plans);

/// Ranks the methods over all studies, and writes that.
void reportRanking(std::span<const study::StudyMeans> studies, const RunRequest& request,
                   report::RunFolder& folder);

}  // namespace gnomon::cli
