#pragma once

#include <span>
#include <string>
#include <string_view>

#include "report/run_folder.h"
#include "study/judge/suite/suite_statistics.h"

namespace gnomon {

/// Writes what the studies of one suite come to, beside their folders: suite.csv, suite.md,
/// suite.html, suite.json, and its plots as plots/suite-*.svg and .pdf. Nothing where suiteOf names
/// no suite.
/// @param command  reproduces the run
/// @returns whether it was written
/// @throws InputError for a file that cannot be written; InternalError as the writers
bool writeSuiteFiles(std::span<const StudyMeans> studies, std::string_view command,
                     RunFolder& folder);

}  // namespace gnomon
