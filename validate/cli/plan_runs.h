#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "cache/cache.h"
#include "cli/case_source.h"
#include "cli/commands/run_command.h"
#include "cli/run_folders.h"
#include "study/judge/study_ranking.h"
#include "study/record/record.h"
#include "study/spec/sweep/sweep.h"

namespace gnomon::cli {

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
PlanRecords runPlan(const study::StudyPlan& plan, CaseSource& cases, const RunRequest& request,
                    cache::Cache& cache, Records& records, const StepJudge& judge = {});

/// Runs one step of a plan, for which the source is prepared, adds its records and writes its
/// folder with its reports.
void runStep(const study::StudyPlan& plan, const study::StudySpec& step, CaseSource& cases,
             const RunRequest& request, cache::Cache& cache, Records& records,
             const StepJudge& judge = {});

/// Writes a plan's reports anew.
void reportPlan(const PlanRecords& part, const RunRequest& request, cache::Cache& cache,
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
