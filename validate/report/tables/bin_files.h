#pragma once

#include <string>

#include "study/record/record.h"

namespace gnomon {

/// The bins as a table, one row a bin, in the record's order; a bin without end has an empty cell
/// there.
/// @throws InternalError for a number that is not finite
std::string binsCsv(const StudyRecord& record);

}  // namespace gnomon
