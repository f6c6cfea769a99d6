#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "report/page/html_page.h"
#include "report/plots/gnuplot.h"
#include "report/text/html.h"
#include "study/judge/ranking.h"
#include "study/record/record.h"
#include "study/record/sweep_record.h"

namespace gnomon::report {

/// The ranking over all studies of a run as one page that loads nothing: the methods from best to
/// worst, the error rates of methods × studies tinted by size, and the claims of all studies with
/// their verdicts. It lies beside the studies' folders and links to their reports.
/// @param command  reproduces the run
/// @throws InternalError for a number that is not finite
Html rankingHtml(std::span<const study::StudyMeans> studies, std::string_view command);

/// The section of the references that a check judged a run by: what kept it from it, those that do
/// not hold with old and new value and their pictures, then how many hold. Nothing, if there were
/// none.
/// @param folder  the run's, where its pictures are
/// @throws InputError for a picture that cannot be read
PageSection referenceSection(const study::StudyRecord& record, const std::filesystem::path& folder);

/// "3 of 4 thresholds met, 118 of 120 references hold, 1 error" with the tag of the status.
/// @param more  "over all values", say; may be empty
Html statusHtml(study::RunStatus status, std::span<const study::Judgement> judgements,
                std::size_t problems, const std::string& more = "");

/// A sweep as one page that loads nothing: its plots, the error rates of methods and cases tinted
/// by size, its claims and the thresholds that failed. It links to the reports of its steps, whose
/// folders lie beside it.
/// @param plots  by their sections: embedded. Without any the page says why
/// @throws InternalError for a number that is not finite
Html sweepHtml(const study::SweepRecord& sweep, const std::vector<DrawnPlot>& plots);

}  // namespace gnomon::report
