#pragma once

#include <string>
#include <vector>

#include "study/record/record.h"

namespace gnomon {

/// Texts of an error budget, the same in every kind of report.

/// A share in percent with its sign and two decimals, "+1.20", "−0.03"; "0.00" for none at all, and
/// "+<0.01" or "−<0.01" for what would round to it.
std::string signedPercent(double share);

/// What the figures are, of how many lights and blocks, and how sure the truth is.
std::string budgetNote(const BudgetRecord& budget);

/// How much of a method's error the order of its causes moves.
std::string orderText(const BudgetRecord& budget);

/// The lights that a record's budgets speak of, each once: all together first.
std::vector<std::string> budgetLights(const StudyRecord& record);

}  // namespace gnomon
