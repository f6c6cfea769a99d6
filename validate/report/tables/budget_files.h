#pragma once

#include <string>

#include "report/json/json_values.h"
#include "study/record/record.h"

namespace gnomon {

/// One error budget: method, view, light, uncertainty, blocks, order_dependence; total, distant and
/// other (each with share, low, high and distinguishable); causes (each with forward and backward);
/// and the error_rate, false_shadow and false_light of every state, forward and backward.
Json jsonBudget(const BudgetRecord& budget);

/// One row a method, light and part of its error: "total", the causes, "distant" and "other". What
/// is not a cause has one share, written as forward and backward alike.
std::string budgetCsv(const StudyRecord& record);

}  // namespace gnomon
