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
