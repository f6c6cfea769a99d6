#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "report/text/html.h"
#include "study/record/record.h"

namespace gnomon::report {

/// The references that a check judged a run by: what kept it from it, those that do not hold with
/// old and new value and their pictures, then how many hold. Nothing, if there were none.
/// @param folder  the run's, where its pictures are
/// @throws InputError for a picture that cannot be read
Html referenceSection(const study::StudyRecord& record, const std::filesystem::path& folder);

/// "3 of 4 thresholds met, 118 of 120 references hold, 1 error" with the tag of the status.
/// @param more  "over all values", say; may be empty
Html statusHtml(study::RunStatus status, std::span<const study::Judgement> judgements,
                std::size_t problems, const std::string& more = "");

}  // namespace gnomon::report
