#pragma once

#include <span>
#include <string>
#include <string_view>

#include "report/paper/paper_options.h"
#include "report/run_folder.h"
#include "study/judge/suite/suite_statistics.h"

namespace gnomon::report {

/// Writes what the studies of one suite come to, beside their folders: suite.csv, suite.md,
/// suite.html, its plots as plots/suite-*.svg and .pdf, and what papers take (paper_files.h).
/// suite.json is left to the caller.
/// @param studies  that the statistics were made of
/// @param command  reproduces the run
/// @throws InputError for a file that cannot be written; InternalError as the writers
void writeSuiteFiles(const study::SuiteStatistics& statistics,
                     std::span<const study::StudyMeans> studies, std::string_view command,
                     const PaperOptions& paper, RunFolder& folder);

/// What of a suite is written.
enum class SuiteParts { all, figures };

/// Writes them, and suite.json, where suiteOf names a suite; of the figures alone suite.csv,
/// suite.md and suite.json, without pages to lead to.
/// @returns whether it does
bool writeSuiteOf(std::span<const study::StudyMeans> studies, std::string_view command,
                  SuiteParts parts, const PaperOptions& paper, RunFolder& folder);

}  // namespace gnomon::report
