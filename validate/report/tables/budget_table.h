#pragma once

#include "report/tables/table.h"
#include "study/record/record.h"

namespace gnomon::report {

/// One method's error by cause, forward and backward: every share with its interval, and ≈ behind
/// one that is not distinguishable from none; then what is left, and all of the error.
Table budgetTable(const study::BudgetRecord& budget);

/// All budgets for programs, one row a method, view, light and part of its error: "total", the
/// causes, "distant" and "other". What is not a cause has one share, written as forward and
/// backward alike.
Table budgetPartsTable(const study::StudyRecord& record);

}  // namespace gnomon::report
