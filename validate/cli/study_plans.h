#pragma once

#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "cli/commands/run_command.h"
#include "cli/output.h"
#include "cli/plan_runs.h"
#include "common/error.h"
#include "study/spec/sweep/sweep.h"

namespace gnomon::cli {

/// Reads the studies of one command, all before the first is run: a typing error in the last one
/// shows at once.
/// @throws InputError as `readStudyPlan`, and for two studies of one name
std::vector<study::StudyPlan> readPlans(const std::vector<std::filesystem::path>& studies,
                                        const study::StudyOptions& options);

/// What the studies of one command ask for, in outline: see StudyOptions.
/// @throws as readPlans, as far as outlines can tell
std::vector<study::StudyPlan> readOutlines(const std::vector<std::filesystem::path>& studies,
                                           study::StudyOptions options);

/// Adds a study's name to those of a command.
/// @throws InputError for one that is among them
void requireNewName(std::set<std::string>& names, const std::filesystem::path& file,
                    const std::string& name);

/// Whether a study is a step of a sweep.
bool isStep(const study::StudySpec& study);

/// The study's file, and of a sweep's step which one it is.
std::string placeOf(const study::StudySpec& study);

/// Does the work of one study. What fails inside it speaks of keys or of the study's other files:
/// its message gets the study's place before it. Output that is lost is nobody's.
template <typename Work>
decltype(auto) inStudy(const study::StudySpec& study, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    if (isOutputLost()) throw;
    throw Error(error.status(), placeOf(study) + ": " + error.what());
  }
}

/// Claims and clears the folders that a command writes to, before anything is written.
void claimFolders(const std::vector<study::StudyPlan>& plans, const RunRequest& request,
                  RunFolders& folders);

/// Measures all plans of a command, one after the other, writes their folders and their ranking,
/// and prints their tables: what runStudies says.
/// @param failures  those of the plans are added
/// @return pass, or the largest status of the failures and of the records' problems
ExitStatus measurePlans(const std::vector<study::StudyPlan>& plans, const RunRequest& request,
                        Failures& failures);

/// Prints the tables of plans whose folders are written, and writes and prints their ranking.
/// @return likewise
ExitStatus finishPlans(std::span<const PlanRecords> plans, const RunRequest& request,
                       Records& records, Failures& failures);

}  // namespace gnomon::cli
