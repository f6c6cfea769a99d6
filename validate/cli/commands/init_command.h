#pragma once

#include <filesystem>
#include <string>

#include "common/error.h"

namespace CLI {
class App;
}

namespace gnomon::cli {

/// What `gnomon init` was asked for.
struct InitRequest {
  std::filesystem::path folder = ".";
  /// Gnomon's repository on GitHub, which the workflow calls: "OWNER/NAME@VERSION"; "none" for no
  /// workflow; empty for the one that this program is a checkout of.
  std::string action;
};

/// Adds the command and its options; they fill `request`.
CLI::App* addInitCommand(CLI::App& app, InitRequest& request);

/// Writes a starter into a folder, which is made if it is missing: a study, a method and a workflow
/// of a build server, copies of scenes/starter; and prints what to do next. No file is written
/// where one of them is there already.
/// @throws UsageError where the action is not known, or has another form; InputError naming the
/// file
///   that is there, or that cannot be written
ExitStatus writeStarter(const InitRequest& request);

}  // namespace gnomon::cli

namespace gnomon::cli {

/// The repository on GitHub that a folder is a checkout of, with its commit, as a workflow's `uses`
/// names it: "OWNER/NAME@COMMIT". Empty where the folder is none, or its remote `origin` is
/// elsewhere.
std::string actionOf(const std::filesystem::path& folder);

/// The commit that is checked out in the user's repository that a folder lies in, which may be yet
/// to be made: as git says, else GitHub's runner in GITHUB_SHA. Empty where neither knows one.
std::string repositoryCommit(const std::filesystem::path& folder);

}  // namespace gnomon::cli
