#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "common/error.h"

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
