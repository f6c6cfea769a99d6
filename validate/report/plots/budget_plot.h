#pragma once

#include <span>

#include "report/plots/plot_sheet.h"
#include "study/record/budget_record.h"

namespace gnomon {

/// The bars of budgetBars as a plot for a paper: two a budget, forward and backward, in percent of
/// the samples, with the names of the parts beside them.
/// @param budgets  of one light, at least one
/// @throws InternalError for a number that is not finite
PlotSheet budgetPlot(std::span<const BudgetRecord> budgets);

}  // namespace gnomon
