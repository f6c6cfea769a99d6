#pragma once

#include <filesystem>

#include "report/json/json_reader.h"
#include "study/record/record.h"

namespace gnomon::report {

/// The record that a study's summary.json tells of, to the bit, as far as tables over several
/// studies, sweeps and suites need it: environment, truth, methods, results, confidence,
/// differences, bins, cost, thresholds, problems, notices, and of its settings the suite's name.
/// Claims, budgets, panels and times are left out.
/// @throws InputError naming file and key for a summary that is damaged
study::StudyRecord readSummary(const JsonReader& summary);

/// @throws InputError likewise, and for a file that cannot be read or has another schema
study::StudyRecord readSummary(const std::filesystem::path& file);

}  // namespace gnomon::report
