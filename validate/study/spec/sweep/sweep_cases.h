#pragma once

#include <vector>

#include "study/spec/sweep/sweep.h"
#include "study/spec/toml/toml_reader.h"

namespace gnomon::study {

/// The `[[sweep]]` tables of a file, one of which may stand as `[sweep]`; none without any.
/// @throws InputError where `sweep` is neither
std::vector<TomlReader> sweepTables(const TomlReader& root);

/// Reads them. Tables with values make a grid, in which the first one's change slowest; a table
/// `with` another one steps with it.
/// @throws InputError naming file, line and key: as sweepValues; for a key
///   without a second value or with repeated ones, that the file cannot have, that names the study,
///   that another table sets too or that `options` overrides; for tables that cannot step together;
///   and for more than options.mostCases cases
Sweep readSweepTables(const std::vector<TomlReader>& tables, const StudyOptions& options);

}  // namespace gnomon::study
