#pragma once

#include <string>

#include "study/record/record.h"

namespace gnomon {

/// The section "Where the error comes from": bars and tables of the study's error budgets; nothing,
/// if it has none.
std::string budgetSection(const StudyRecord& record);

}  // namespace gnomon
