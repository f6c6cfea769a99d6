#pragma once

#include <span>

#include "report/plots/study_plots.h"
#include "report/text/html.h"
#include "study/record/record.h"

namespace gnomon {

/// The section "Where the error comes from": the plots and tables of the study's error budgets, all
/// lights together, then folded away each light; nothing, if it has none.
/// @param plots  of the run; those of other sections are passed over
Html budgetSection(const StudyRecord& record, std::span<const DrawnPlot> plots);

}  // namespace gnomon
