#pragma once

#include <string>

#include "cli/commands/view_command.h"

namespace gnomon::cli {

/// The whole program: parses the command line, runs the command, turns every error into one line on
/// standard error and its exit status (see ExitStatus). Output that could not be written is such an
/// error: see output.h. So is a JUnit file without a result: see commands/baseline_check.h.
/// @param viewer  what `gnomon view` calls
int runCommandLine(int argc, char** argv, const Viewer& viewer);

}  // namespace gnomon::cli

namespace CLI {
class App;
}

namespace gnomon::cli {

/// The manual page gnomon(1) in the language of man(7), UTF-8: every command with its options and
/// examples, as `--help` has them.
std::string manualPage(const CLI::App& app, const std::string& version);

}  // namespace gnomon::cli
