#pragma once

#include <string>
#include <vector>

#include "study/record/record.h"

namespace gnomon {

/// Texts of an error budget, the same in every kind of report.

/// What is left of an error once all causes are undone.
constexpr const char* distantName = "left: distant occluders";
constexpr const char* otherName = "left: other";

/// What the figures are, of how many lights and blocks, and how sure the truth is.
std::string budgetNote(const BudgetRecord& budget);

/// How much of a method's error the order of its causes moves.
std::string orderText(const BudgetRecord& budget);

/// The lights that a record's budgets speak of, each once: all together first.
std::vector<std::string> budgetLights(const StudyRecord& record);

/// The budgets of one light, in the order of the record.
std::vector<BudgetRecord> budgetsOf(const StudyRecord& record, const std::string& light);

}  // namespace gnomon
