#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/error.h"
#include "report/tables/latex_table.h"

namespace CLI {
class App;
}

namespace gnomon::cli {

/// What `gnomon rank` was asked for.
struct RankRequest {
  std::vector<std::filesystem::path> shaders;    ///< GLSL files, each an entry labelled by its stem
  std::vector<std::filesystem::path> masks;      ///< of other renderers: a subfolder a scene
  std::optional<std::filesystem::path> methods;  ///< further entries, as scenes/suite/methods.toml
  std::string suite = "suite-1";
  int scenes = 24;  ///< the first ones of the suite
  std::filesystem::path out = "out/rank";
  bool noCache = false;
  report::PaperOptions paper;
  std::string command;  ///< the command line, for the page
};

/// Adds the command `rank` with its options.
CLI::App* addRankCommand(CLI::App& app, RankRequest& request);

/// Draws the test scenes of a suite, measures the given entries and the control on them, joins them
/// with the committed errors of all methods and writes the statistics as `gnomon gather` does:
/// suite.html, suite.csv, suite.md, plots and last suite.json, with the scenes in `out/scenes`,
/// their figures in `out/results` and reports of the entries' worst ones in `out/worst`. Prints the
/// place of each entry, its neighbours, where it wins and loses, and its worst scenes. A run that
/// is started again finds in the cache what it has measured.
/// @throws UsageError without an entry; InputError as readStandings and joined, for scenes that are
///   not those of the committed errors, and for two entries of one label
ExitStatus rankEntries(const RankRequest& request);

}  // namespace gnomon::cli
