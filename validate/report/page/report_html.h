#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "report/page/html_page.h"
#include "report/plots/drawn_plots.h"
#include "report/tables/table.h"
#include "report/text/html.h"
#include "study/record/record.h"

namespace gnomon::report {

/// A run as one page that needs nothing beside it: style and pictures are inside, and its own
/// content policy forbids it to load anything. Of many cases the pictures have pages of their own
/// (casePages). In the order of a reader's questions: which method is best and how sure that is
/// (opening, ranking), where methods are wrong, what they cost, whether claims, thresholds and
/// references hold; then the pictures, and folded all that explains the figures.
/// @param folder  the run's folder: where the paths of the pictures start
/// @param plots   embedded, in this order
/// @throws InputError if a difference or the truth's mask cannot be read, InternalError if it is no
///   PNG, or for a number that is not finite
Html reportHtml(const study::StudyRecord& record, const std::filesystem::path& folder,
                std::span<const DrawnPlot> plots = {});

/// Its section on intervals, of a study of several views: for each a table of its methods, ranked
/// with their intervals. Empty of a single view, of which the ranking has them.
PageSection confidenceSection(const study::StudyRecord& record);

/// Its section "Where the error comes from": the plots and tables of the study's error budgets, all
/// lights together, then folded away each light; nothing, if it has none.
PageSection budgetSection(const study::StudyRecord& record);

/// Tables of a run itself.

/// The truth's uncertainty in each view under each light.
Table flipTable(const std::vector<study::UncertaintyRecord>& flips);
/// The time of each stage, seconds.
Table timingTable(const std::vector<study::TimingRecord>& timings);
/// Each file that the run was made of.
Table inputTable(const std::vector<study::InputRecord>& inputs);

}  // namespace gnomon::report
