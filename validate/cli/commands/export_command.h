#pragma once

#include <optional>

#include "cli/commands/run_command.h"

namespace gnomon::cli {

/// Traces the truth of the studies, without any method, and writes it into `out/NAME/truth`; see
/// `writeTruth`. The file that describes the rest is written last and removed first: where it is,
/// the folder is whole.
ExitStatus traceStudies(const RunRequest& request);

/// Writes into `out/NAME/export` what another renderer needs to answer at the studies' samples:
/// the displaced mesh, the base mesh, the height map, the tables, the sample maps, truths and
/// regions of interest, and last `export.json`, which describes them.
/// @param subdivisions  pieces of every face's side in the displaced mesh; `subdivisionsForTexels`
///   where unset
ExitStatus exportStudies(const RunRequest& request, std::optional<int> subdivisions);

}  // namespace gnomon::cli
