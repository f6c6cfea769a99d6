#pragma once

#include <span>
#include <vector>

#include "study/record/sweep_record.h"
#include "study/spec/sweep/sweep.h"
#include "study/spec/toml_reader.h"

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

/// Names the cases of a sweep, each distinct, also where a file system takes a letter and its
/// capital for one; of letters, digits, `-`, `_` and `.`, and at most 64 of them.
///   one key of numbers        the value: "0.25", "1e+20" (the only name with a `+`)
///   otherwise                 a part for each key, "height-2_elevation-30", by the last part of
///                             the key's name, or by the whole name where two end alike
///   where these are longer, or two are the same: "case-0042", by their order
void nameCases(std::span<const SweptKey> keys, std::vector<SweepCase>& cases);

}  // namespace gnomon::study
