#pragma once

namespace gnomon {

/// The whole program: parses the command line, runs the command, turns every error into one line on
/// standard error and its exit status (see ExitStatus).
int runCommandLine(int argc, char** argv);

}  // namespace gnomon
