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

/// Whether a refusal is as every one should be: one line on standard error that begins with
/// `gnomon: `, and the status of bad input.
void expectRefused(const Outcome& outcome, const std::string& what);

}  // namespace gnomon::test
