#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands/shards.h"
#include "common/error.h"
#include "report/tables/latex_table.h"
#include "study/run/scene/environment.h"
#include "study/spec/study_file.h"
#include "study/spec/sweep/sweep.h"

namespace gnomon::cli {

/// What `gnomon run` was asked for.
struct RunRequest {
  std::vector<std::filesystem::path> studies;
  std::filesystem::path out = "out";
  study::StudyOptions options;
  bool noCache = false;
  /// Figures alone: no masks, pictures, pages, plots and times. Then the same input gives the same
  /// folder, byte for byte.
  bool metricsOnly = false;
  bool isQuiet = false;  ///< prints no table, and ranks no methods over the studies
  report::PaperOptions paper;
  std::string command;                 ///< the command line, for the report
  std::vector<std::string> arguments;  ///< the same, word by word
  std::optional<Shard> shard;          ///< runs only this part of the cases, see runShard
  study::StageProgress progress;  ///< told how far a run is; a line on the terminal, if it is empty
};

/// Runs the studies one after the other and writes each one's folder `out/NAME`: pictures and masks
/// as they are made, then metrics.csv, report.html and last summary.json, whose presence says that
/// the run is whole. Prints a table for each.
/// A sweep has such a folder for each value, `out/NAME/VALUE`, and in `out/NAME` its own sweep.csv,
/// cases.csv, table.tex, plots/sweep.svg, report.html and last summary.json.
/// Every folder holds its study, with the options in it, as NAME.toml: see resolved_study.h.
/// With `metricsOnly` a study's folder holds its copy, cases.csv and summary.json, and a sweep has
/// no folder a value.
/// A study that fails does not keep the others from their tables, nor what is whole from its
/// ranking; but all studies are read before the first is run. Two studies or more are followed by a
/// ranking of the methods over all of them: printed, and written as `out/ranking.csv`,
/// `ranking.md`, `ranking.html` and last `ranking.json`.
/// Before the first study is run, the summaries that earlier runs of these studies left are
/// removed; each study's folder is replaced when it is whole: see RunFolder. Thresholds are judged
/// and recorded, but decide nothing: see checkStudies.
/// @return pass, or the largest status of the studies that failed
ExitStatus runStudies(const RunRequest& request);

/// Bakes the tables of the studies and writes them as `out/NAME/tables.exr`.
ExitStatus bakeStudies(const RunRequest& request);

/// Adds an option that may be repeated and takes one value each time.
inline CLI::Option* addList(CLI::App& command, const std::string& name,
                            std::vector<std::string>& values, const std::string& about,
                            const char* type) {
  return command.add_option(name, values, about)
      ->type_name(type)
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

}  // namespace gnomon::cli

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace gnomon::cli {

/// Adds the options that say what is written for a paper.
/// @return --figures
CLI::Option* addPaperOptions(CLI::App& command, report::PaperOptions& options);

/// Adds the labels of the methods that a study measures, each once.
void appendLabels(const study::StudyPlan& plan, std::vector<std::string>& labels);

/// @throws UsageError for a chosen method that none of the studies measures
void requirePaperMethods(const report::PaperOptions& options,
                         const std::vector<study::StudyPlan>& plans);

/// @param measured  labels
/// @throws UsageError for a chosen method that none of them is
void requirePaperMethods(const report::PaperOptions& options,
                         const std::vector<std::string>& measured);

/// Traces the truth of the studies, without any method, and writes it into `out/NAME/truth`; see
/// `writeTruth`. The file that describes the rest is written last and removed first: where it is,
/// the folder is whole.
ExitStatus traceStudies(const RunRequest& request);

/// Writes into `out/NAME/export` what another renderer needs to answer at the studies' samples:
/// the displaced mesh, the base mesh, the height map, the tables, the sample maps, truths and
/// regions of interest, and last `export.json`, which describes them.
/// @param subdivisions  pieces of every face's side in the displaced mesh; `subdivisionsForTexels`
///   where unset
ExitStatus exportStudies(const RunRequest& request, std::optional<int> subdivisions);

}  // namespace gnomon::cli
