#pragma once

#include <span>

#include "report/plots/plot_sheet.h"
#include "study/record/budget_record.h"

namespace gnomon::report {

/// Error budgets as bars, two a budget, forward and backward, in percent of the samples or of the
/// light: shares above 0 stand to the right of the zero line one after the other, those below it to
/// its left, and a mark where both together end, at the method's error.
/// @param budgets  of one light, at least one
/// @param isSoft   whether errors are shares of light (study::isSoft)
/// @throws InternalError for a number that is not finite
PlotSheet budgetPlot(std::span<const study::BudgetRecord> budgets,
                     PlotPlace place = PlotPlace::paper, bool isSoft = false);

}  // namespace gnomon::report
