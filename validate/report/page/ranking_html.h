#pragma once

#include <span>
#include <string_view>

#include "report/text/html.h"
#include "study/judge/study_ranking.h"

namespace gnomon::report {

/// The ranking over all studies of a run as one page that loads nothing: the methods from best to
/// worst, the error rates of methods × studies tinted by size, and the claims of all studies with
/// their verdicts. It lies beside the studies' folders and links to their reports.
/// @param command  reproduces the run
/// @throws InternalError for a number that is not finite
Html rankingHtml(std::span<const study::StudyMeans> studies, std::string_view command);

}  // namespace gnomon::report
