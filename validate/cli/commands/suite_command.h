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

/// What `gnomon suite` was asked for.
struct SuiteRequest {
  std::string seed;
  int scenes = 200;
  std::string split = "test";
  std::optional<std::filesystem::path> out;  ///< nothing is written without it
  std::optional<std::filesystem::path> from, methods, settings;
};

/// Adds the command `suite` with its options.
CLI::App* addSuiteCommand(CLI::App& app, SuiteRequest& request);

/// Draws the scenes, writes them, and prints the SHA-256 of the whole.
/// @throws InputError as readSuite, readSuiteMethods, drawSuite and writeSuite
ExitStatus drawSuiteScenes(const SuiteRequest& request);

}  // namespace gnomon::cli

namespace CLI {
class App;
}

namespace gnomon::cli {

/// What `gnomon gather` was asked for.
struct GatherRequest {
  std::vector<std::filesystem::path> folders;  ///< of results
  std::filesystem::path out = "out/suite";
  std::optional<std::filesystem::path> against;  ///< another suite's suite.json
  std::optional<std::filesystem::path> choose;   ///< where the chosen settings go
  std::optional<std::filesystem::path> methods;  ///< the list whose settings were tried
  report::PaperOptions paper;
  std::string command;  ///< the command line, for the report
};

/// Adds the command `gather` with its options.
CLI::App* addGatherCommand(CLI::App& app, GatherRequest& request);

/// Writes the statistics over the scenes that finished runs left: suite.csv, suite.md, suite.html,
/// plots/suite-* and last suite.json. With `against` it also prints how the ranking agrees with the
/// other one. With `choose`, for scenes of train, it writes the settings that are best on them:
/// see triedSettings.
/// @throws InputError where the folders hold fewer than 20 scenes of a suite, scenes of several
///   suites or one scene twice; as readFinishedScenes and triedSettings
ExitStatus gatherScenes(const GatherRequest& request);

}  // namespace gnomon::cli
