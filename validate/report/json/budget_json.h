#pragma once

#include "report/json/json_values.h"

namespace gnomon {

/// One error budget: method, view, light, uncertainty, blocks, order_dependence; total, distant and
/// other (each with share, low, high and distinguishable); causes (each with forward and backward);
/// and the error_rate, false_shadow and false_light of every state, forward and backward.
Json jsonBudget(const BudgetRecord& budget);

}  // namespace gnomon
