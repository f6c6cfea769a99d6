#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "report/json/json_values.h"
#include "study/record/record.h"

namespace gnomon::report {

/// The value of "schema". A reader may rely on the keys below as long as it does not change.
constexpr std::string_view summarySchema = "gnomon-summary/2";

/// A whole run as JSON, keys in a fixed order, text as UTF-8 (bytes that are not become U+FFFD).
/// schemas/gnomon.schema.json documents every key.
/// @throws InternalError naming the key for a number that is not finite
std::string summaryJson(const study::StudyRecord& record);

/// The record that a study's summary.json tells of, to the bit, as far as tables over several
/// studies, sweeps and suites need it: environment, truth, methods, results, confidence,
/// differences, bins, cost, thresholds, problems, notices, and of its settings the suite's name.
/// Claims, budgets, panels and times are left out.
/// @throws InputError naming file and key for a summary that is damaged
study::StudyRecord readSummary(const JsonReader& summary);

/// @throws InputError likewise, and for a file that cannot be read or has another schema
study::StudyRecord readSummary(const std::filesystem::path& file);

}  // namespace gnomon::report
