#pragma once

#include "report/run_folder.h"
#include "study/record/record.h"
#include "study/record/sweep_record.h"

namespace gnomon::report {

/// What a run with `--metrics-only` leaves: figures, and nothing that two runs of the same study
/// with the same program do not share. Folders are the same, byte for byte.

/// A record without what tells of the run alone: times, threads, the cache's counts, and the memory
/// of the ray tracing structure.
/// @param isStep  of a sweep, whose long table has no bins: these go too
study::StudyRecord figuresAlone(study::StudyRecord record, bool isStep);

/// Writes cases.csv (longCsv), then summary.json.
/// @throws InputError for a file that cannot be written
void writeFigureFiles(const study::StudyRecord& record, RunFolder& folder);
/// Likewise a sweep's.
void writeFigureFiles(const study::SweepRecord& sweep, RunFolder& folder);

}  // namespace gnomon::report
