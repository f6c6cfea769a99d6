#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "study/record/record.h"

namespace gnomon::report {

/// Texts of an error budget, the same in every kind of report.

/// Of an error that remains when all causes are corrected, "left: seam".
/// @param rest  as BudgetRest::name
std::string restName(std::string_view rest);

/// What the figures mean, of how many lights and blocks they are, and the truth's uncertainty.
/// @param isSoft  whether errors are shares of light (study::isSoft)
std::string budgetNote(const study::BudgetRecord& budget, bool isSoft = false);

/// How much of a method's error is assigned to another cause in the other order.
std::string orderText(const study::BudgetRecord& budget, bool isSoft = false);

/// The lights of a record's budgets, each once: all together first.
std::vector<std::string> budgetLights(const study::StudyRecord& record);

/// The budgets of one light, in the order of the record.
std::vector<study::BudgetRecord> budgetsOf(const study::StudyRecord& record,
                                           const std::string& light);

}  // namespace gnomon::report
