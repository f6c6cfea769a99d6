#pragma once

#include "cache/cache.h"
#include "report/paper/paper_options.h"
#include "report/run_folder.h"
#include "study/record/record.h"
#include "study/record/sweep_record.h"

namespace gnomon::report {

/// The files of a run beside its pictures. Each is written whole or not at all.

/// Writes a study's: metrics.csv, bins.csv, frontier.csv, budget.csv (where there are any), its
/// ranked table as table.csv and .md, what papers take (paper_files.h), plots/NAME.svg and .pdf,
/// report.html, and last summary.json, so that its presence says that the run is whole. An older
/// one goes first.
/// @param cache  keeps plots
/// @throws InputError for a file that cannot be written or a picture that cannot be read;
///   InternalError as the writers
void writeRunFiles(const study::StudyRecord& record, const PaperOptions& paper, RunFolder& folder,
                   cache::Cache& cache);

/// Writes a sweep's: sweep.csv, cases.csv, what papers take, its plots as plots/*.svg and .pdf,
/// report.html, summary.json.
/// @throws likewise
void writeSweepFiles(const study::SweepRecord& sweep, const PaperOptions& paper, RunFolder& folder,
                     cache::Cache& cache);

}  // namespace gnomon::report
