#pragma once

#include <string>

#include "study/record/record.h"

namespace gnomon {

/// One row a method, light and part of its error: "total", the causes, "distant" and "other". What
/// is not a cause has one share, written as forward and backward alike.
std::string budgetCsv(const StudyRecord& record);

}  // namespace gnomon
