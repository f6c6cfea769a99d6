#pragma once

#include "cli/commands/view_request.h"

namespace gnomon::cli {

/// The whole program: parses the command line, runs the command, turns every error into one line on
/// standard error and its exit status (see ExitStatus). Output that could not be written is such an
/// error: see output.h. So is a JUnit file without a result: see junit_file.h.
/// @param viewer  what `gnomon view` calls
int runCommandLine(int argc, char** argv, const Viewer& viewer);

}  // namespace gnomon::cli
