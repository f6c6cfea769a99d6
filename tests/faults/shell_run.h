#pragma once

#include <filesystem>
#include <string>

#include "end_to_end/support/program.h"

namespace gnomon::test {

/// The status by which a run shows that it did not come to its end in time.
constexpr int timedOut = 124;

/// How a command of a shell is run.
struct ShellOptions {
  /// "sh" for limits and redirections whose units and rules POSIX fixes.
  const char* shell = "bash";
  int seconds = 60;         ///< that it may take: its status is then `timedOut`
  bool keepsCache = false;  ///< in `.cache` of the folder, from command to command
};

/// Runs a shell's command in a folder. `gnomon` in it is the program, and `$gnomon` its path; it
/// has a cache of its own.
Outcome runShell(const std::filesystem::path& folder, const std::string& command,
                 const ShellOptions& options = {});

/// All bytes of a file; none where it cannot be read.
std::string bytesOf(const std::filesystem::path& path);

/// Whether a refusal is as every one should be: one line on standard error that begins with
/// `gnomon: `, and the status of bad input.
void expectRefused(const Outcome& outcome, const std::string& what);

}  // namespace gnomon::test
