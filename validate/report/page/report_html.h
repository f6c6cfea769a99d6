#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "report/plots/drawn_plots.h"
#include "report/tables/table.h"
#include "report/text/html.h"
#include "study/record/record.h"

namespace gnomon::report {

/// A run as one page that needs nothing beside it: style and pictures are inside, and its own
/// content policy forbids it to load anything. Of many cases the pictures have pages of their own
/// (casePages). In the order of a reader's questions: which
/// method is right (opening, claims, ranking, thresholds), where are they wrong (pictures and
/// regions a case, worst places), what do they cost, how far can the truth be trusted, how is it
/// run again, what do the words mean.
/// @param folder  the run's folder: where the paths of the pictures start
/// @param plots   embedded, in this order
/// @throws InputError if a difference or the truth's mask cannot be read, InternalError if it is no
///   PNG, or for a number that is not finite
Html reportHtml(const study::StudyRecord& record, const std::filesystem::path& folder,
                std::span<const DrawnPlot> plots = {});

/// Its section on intervals: for each view its verdict and a table of its methods, ranked with
/// their intervals. Empty if the record has no intervals.
Html confidenceSection(const study::StudyRecord& record);

/// Its section "Where the error comes from": the plots and tables of the study's error budgets, all
/// lights together, then folded away each light; nothing, if it has none.
/// @param plots  of the run; those of other sections are passed over
Html budgetSection(const study::StudyRecord& record);

/// Tables of a run itself.

/// The truth's uncertainty in each view under each light.
Table flipTable(const std::vector<study::UncertaintyRecord>& flips);
/// The time of each stage, seconds.
Table timingTable(const std::vector<study::TimingRecord>& timings);
/// Each file that the run was made of.
Table inputTable(const std::vector<study::InputRecord>& inputs);

}  // namespace gnomon::report
