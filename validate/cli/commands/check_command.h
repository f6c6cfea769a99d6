#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/commands/run_command.h"
#include "common/error.h"

namespace gnomon::cli {

/// What `gnomon check` was asked for.
struct CheckRequest {
  RunRequest run;
  std::optional<std::filesystem::path> junit;  ///< where JUnit XML goes
  bool github = false;                         ///< workflow commands on standard output
  /// A file that a job summary in Markdown is added to.
  std::optional<std::filesystem::path> summary;
  std::optional<std::filesystem::path> baseline;  ///< folder of the references, NAME.json a study
  bool updateBaseline = false;                    ///< writes them in place of judging by them
  std::string reason;                             ///< why; kept in the file
  bool baselinePictures = false;                  ///< keeps pictures beside them
};

/// Runs the studies as runStudies does and judges their thresholds, and with a baseline their
/// references. A study that cannot be run does not keep the others from it. Prints every threshold
/// with value, limit and margin, what failed in full, and the command that reproduces it.
///
/// Nothing passes for want of something to judge: a study without gates, a gate that matches no
/// result, a value that is undefined or not finite, a view that shows nothing, a missing reference
/// are all faults.
///
/// The JUnit file, which the command line has made to say "error" (see baseline_check.h), has one
/// for each study that has not been judged yet from before the first run on.
///
/// A summary holds all that is known at the end; a check that is killed adds nothing to it.
///
/// References are written for studies of which everything passed, and only those.
/// @return the largest status of all studies: pass, thresholdFailed (also: a regression, an
///   undefined value), usage, badInput, internal, noGl
/// @throws UsageError for options that contradict each other
ExitStatus checkStudies(const CheckRequest& request);

}  // namespace gnomon::cli
