#pragma once

#include <filesystem>
#include <string>

#include "end_to_end/program.h"

namespace gnomon::test {

/// The status by which a run shows that it did not come to its end in time.
constexpr int timedOut = 124;

/// Runs a shell's command in a folder, with `gnomon` in it for the program and a cache of its own,
/// for at most a while; its status is then `timedOut`.
Outcome runShell(const std::filesystem::path& folder, const std::string& command, int seconds = 60);

/// Runs a script of the POSIX shell likewise, for limits and redirections whose units and rules it
/// fixes. `$gnomon` is the program; its cache is the folder's, and stays from script to script. No
/// time is set.
Outcome runPosixShell(const std::filesystem::path& folder, const std::string& script);

/// All bytes of a file; none where it cannot be read.
std::string bytesOf(const std::filesystem::path& path);

/// Whether a refusal is as every one should be: one line on standard error that begins with
/// `gnomon: `, and the status of bad input.
void expectRefused(const Outcome& outcome, const std::string& what);

}  // namespace gnomon::test
