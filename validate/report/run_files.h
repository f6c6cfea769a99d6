#pragma once

#include <filesystem>

#include "cache/cache.h"
#include "study/record.h"
#include "study/sweep_record.h"

namespace gnomon {

/// The files of a run beside its pictures. Each is written whole or not at all.

/// Removes what tells of an earlier run of a study or sweep, so that nothing older stands beside the
/// newer: all files below, plots, pictures and masks. The study's copy stays.
void removeRunFiles(const std::filesystem::path& folder);

/// Writes a study's: metrics.csv, bins.csv, frontier.csv, budget.csv (where there are any),
/// table.csv, table.tex, plots/NAME.svg and .pdf, report.html, and last summary.json, so that its
/// presence says that the run is whole.
/// @param cache  keeps plots
/// @throws InputError for a file that cannot be written or a picture that cannot be read;
///   InternalError as the writers
void writeRunFiles(const StudyRecord& record, const std::filesystem::path& folder, Cache& cache);

/// Writes a sweep's: sweep.csv, its plots as plots/*.svg and .pdf, report.html, summary.json.
/// @throws likewise
void writeSweepFiles(const SweepRecord& sweep, const std::filesystem::path& folder, Cache& cache);

}  // namespace gnomon
